// Steps of a sheet by springs: included by kernels.inl.
//
// Each row is processed in chunks of columns, each chunk in two sweeps. The first computes the forward
// springs of every node, to the right and to the next two rows, three at a time. The second sums them at both
// ends. This equals the gather of `spring_force` over twelve neighbours, but computes each spring once: the
// forces on its ends are exact negatives, and every node still adds its neighbours in the order of
// `sheet_neighbours`.
//
// Several steps run in one pass over the rows: step k is three rows behind step k - 1, on rows that are still
// in the cache (Wonnacott, "Using time skewing to eliminate idle time due to memory bandwidth", 2000). It
// overwrites the state before the last, whose row is no longer needed.

constexpr int forward_springs = 6;
constexpr int springs_at_once = 3;  // the fastest of 1, 2, 3 and 6
using Springs = Group<Number, springs_at_once>;
using LawsOfSprings = Laws<Springs>;
constexpr const SheetNeighbour* forward_neighbours = sheet_neighbours + forward_springs;

/// Forces on nodes by their forward springs, N, for a chunk of columns and the pack before it.
struct ChunkForces {
    static constexpr std::ptrdiff_t columns = 128, before = 16;
    float numbers[forward_springs][3][before + columns];

    Vector at(int n, std::ptrdiff_t column) const
    {
        const auto& f = numbers[n];
        return {Number::load(f[0] + before + column), Number::load(f[1] + before + column),
                Number::load(f[2] + before + column)};
    }
    void set(int n, std::ptrdiff_t column, const Vector& force)
    {
        auto& f = numbers[n];
        force.x.store(f[0] + before + column);
        force.y.store(f[1] + before + column);
        force.z.store(f[2] + before + column);
    }
};
inline Vector nothing() { return {Number(0.0f), Number(0.0f), Number(0.0f)}; }

/// Forces of three forward springs of a pack, beginning with the n-th.
template <bool interior, int n>
PLIANT_INLINE void spring_forces_from(const SheetArguments& a, const Block& block, std::ptrdiff_t in_chunk,
                                      ChunkForces& forces)
{
    using SpringVectors = LawsOfSprings::vec3;
    const StepConstants<float>& c = *a.constants;
    const auto stride = static_cast<std::ptrdiff_t>(a.layout->stride);
    const auto at_both = [&](const ConstVectors& v, auto&& of) {
        return SpringVectors{of(v.x + block.offset), of(v.y + block.offset), of(v.z + block.offset)};
    };
    const auto here = [](const float* p) {
        const Number value = Number::load(p);
        return Springs::of([&]<int k>() { return value; });
    };
    const auto there = [&](const float* p) {
        return Springs::of([&]<int k>() {
            constexpr SheetNeighbour neighbour = forward_neighbours[n + k];
            return Number::load(p + neighbour.row_offset * stride + neighbour.column_offset);
        });
    };
    const auto of_class = [&](const float* values) {
        return Springs::of([&]<int k>() {
            return Number(values[static_cast<std::size_t>(forward_neighbours[n + k].spring_class)]);
        });
    };
    const SpringVectors f = LawsOfSprings::spring_force(
        at_both(a.position, here), at_both(a.position, there), at_both(a.velocity, here),
        at_both(a.velocity, there),
        Springs::of([&]<int k>() { return Number(c.rest_lengths[forward_neighbours[n + k].rest]); }),
        of_class(c.stiffness), of_class(c.damping));
    Springs::of([&]<int k>() {
        constexpr SheetNeighbour neighbour = forward_neighbours[n + k];
        Vector force = {f.x.template member<k>(), f.y.template member<k>(), f.z.template member<k>()};
        if (!interior) {
            const auto columns = static_cast<std::ptrdiff_t>(a.layout->columns);
            const bool beyond =
                block.row + neighbour.row_offset >= static_cast<std::ptrdiff_t>(a.layout->rows);
            const L::mask both_ends =
                L::both(lanes_on_sheet(block.column, columns),
                        lanes_on_sheet(block.column + neighbour.column_offset, columns));
            force = beyond ? nothing() : L::choose(both_ends, force, nothing());
        }
        forces.set(n + k, in_chunk, force);
        return Number();
    });
}

/// Second sweep: sums the forces on a pack and steps it.
PLIANT_INLINE void move_nodes(const SheetArguments& a, const Vectors& carried, const Block& block,
                              std::ptrdiff_t in_chunk, const ChunkForces& forces)
{
    const auto at = [&](int n, std::ptrdiff_t shift) { return forces.at(n, in_chunk + shift); };
    Vector force = load(carried, block.column) - at(1, -2) - at(0, -1);
    force = force + at(0, 0) + at(1, 0) + at(2, 0) + at(3, 0) + at(4, 0) + at(5, 0);
    if (a.external_force.x) force = force + load(a.external_force, block.offset);
    const L::Motion now = {load(a.position, block.offset), load(a.velocity, block.offset)};
    const L::Motion next = stepped(a, now, force, Number::load(a.inverse_mass + block.offset));
    store(a.next_position, block.offset, next.position);
    store(a.next_velocity, block.offset, next.velocity);
}

/// Passes the forces of a row's springs on to the next row, one column late, when all of them are known.
PLIANT_INLINE void carry_on(const Vectors& below, std::ptrdiff_t column, std::ptrdiff_t in_chunk,
                            const ChunkForces& forces)
{
    store(below, column - 1,
          load(below, column - 1) - forces.at(4, in_chunk - 2) - forces.at(3, in_chunk - 1) -
              forces.at(2, in_chunk));
}

/// One row of a step. Without `moves` the row is another part's, and only its springs' forces on later rows
/// are needed.
template <bool moves>
PLIANT_IN_ONE_PIECE void step_row(const SheetArguments& a, const Vectors& here, const Vectors& below,
                                  std::ptrdiff_t row)
{
    const auto columns = static_cast<std::ptrdiff_t>(a.layout->columns);
    const bool inner_row = row + 2 < static_cast<std::ptrdiff_t>(a.layout->rows);
    alignas(64) ChunkForces forces;
    for (int n = 0; n < forward_springs; ++n) forces.set(n, -width, nothing());
    const auto block_at = [&](std::ptrdiff_t column) {
        return Block{row, column, offset_of(*a.layout, row, column),
                     inner_row && column >= 1 && column + width + 2 <= columns};
    };
    for (std::ptrdiff_t first = 0; first < columns; first += ChunkForces::columns) {
        const std::ptrdiff_t count =
            columns - first < ChunkForces::columns ? columns - first : ChunkForces::columns;
        std::ptrdiff_t k = 0;
        for (; k < count; k += width) {
            const Block block = block_at(first + k);
            if (block.interior) {
                spring_forces_from<true, 0>(a, block, k, forces);
                spring_forces_from<true, springs_at_once>(a, block, k, forces);
            } else {
                spring_forces_from<false, 0>(a, block, k, forces);
                spring_forces_from<false, springs_at_once>(a, block, k, forces);
            }
        }
        const std::ptrdiff_t end = k;
        for (k = 0; k < end; k += width) {
            if (moves) move_nodes(a, here, block_at(first + k), k, forces);
            carry_on(below, first + k, k, forces);
            store(here, first + k,
                  nothing() - forces.at(5, k));  // of the row after the next, stored in this one's place
        }
        for (int n = 0; n < forward_springs; ++n) forces.set(n, -width, forces.at(n, end - width));
    }
    forces.set(2, 0, nothing());
    carry_on(below, (columns + width - 1) / width * width, 0, forces);
}

void sheet_steps(const SheetStretch& s)
{
    constexpr std::ptrdiff_t reach = 2;        // rows that a spring spans
    constexpr std::ptrdiff_t lag = reach + 1;  // rows by which a step is behind the one before
    const auto stride = static_cast<std::ptrdiff_t>(s.steps->layout->stride);
    const std::size_t size = SheetStretch::carried_size(s.steps->layout->stride);
    const auto carried = [&](std::size_t step, std::ptrdiff_t row) {
        float* x = s.carried + size * step + 3 * stride * (row & 1) + NodeLayout::pad;
        return Vectors{x, x + stride, x + 2 * stride};
    };
    std::ptrdiff_t first = s.rows[0].begin, end = s.rows[0].end;
    for (std::size_t k = 0; k < s.count; ++k) {
        const std::ptrdiff_t shift = lag * static_cast<std::ptrdiff_t>(k);
        if (s.rows[k].begin - reach + shift < first) first = s.rows[k].begin - reach + shift;
        if (s.rows[k].end + shift > end) end = s.rows[k].end + shift;
        // Clears all of it, whatever the width: remains of an earlier call would be added to these nodes.
        for (std::size_t i = 0; i < size; ++i) s.carried[size * k + i] = 0;
    }
    for (std::ptrdiff_t front = first; front < end; ++front)
        for (std::size_t k = 0; k < s.count; ++k) {
            const std::ptrdiff_t row = front - lag * static_cast<std::ptrdiff_t>(k);
            if (row < 0 || row < s.rows[k].begin - reach || row >= s.rows[k].end) continue;
            const Vectors here = carried(k, row), below = carried(k, row + 1);
            row >= s.rows[k].begin ? step_row<true>(s.steps[k], here, below, row)
                                   : step_row<false>(s.steps[k], here, below, row);
        }
}
