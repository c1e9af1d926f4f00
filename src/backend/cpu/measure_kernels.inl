// Measures at the end of a frame: included by kernels.inl.

/// Measures of the nodes of a block, by number: the input of the fixed tree.
struct BlockMeasures {
    static constexpr int numbers = 8;
    float values[numbers][block_size + 16];  // padding: a pack may be read and written beyond the end

    L::Measure at(std::size_t k) const
    {
        const auto number = [&](int n) { return Number::load(values[n] + k); };
        L::Measure m;
        m.max_stretch = number(0);
        m.max_penetration = number(1);
        m.max_speed2 = number(2);
        m.stretch_sum = number(3);
        m.kinetic_energy = number(4);
        m.elastic_energy = number(5);
        m.height_moment = number(6);
        m.non_finite = number(7);
        return m;
    }
    void set(std::size_t k, const L::Measure& m)
    {
        const Number all[numbers] = {m.max_stretch,    m.max_penetration, m.max_speed2,    m.stretch_sum,
                                     m.kinetic_energy, m.elastic_energy,  m.height_moment, m.non_finite};
        for (int n = 0; n < numbers; ++n) all[n].store(values[n] + k);
    }
};

inline L::Measure chosen(L::mask m, const L::Measure& a, const L::Measure& b)
{
    L::Measure c = b;
    c.max_stretch = L::choose(m, a.max_stretch, b.max_stretch);
    c.stretch_sum = L::choose(m, a.stretch_sum, b.stretch_sum);
    c.elastic_energy = L::choose(m, a.elastic_energy, b.elastic_energy);
    return c;
}

/// Forward springs of a pack of nodes: each spring is counted once.
inline L::Measure measured_springs(const MeasureArguments& a, const Block& block, const Vector& x)
{
    const StepConstants<float>& c = *a.constants;
    const auto stride = static_cast<std::ptrdiff_t>(a.layout->stride);
    const L::mask always = Number(1.0f) > Number(0.0f), never = Number(0.0f) > Number(1.0f);
    L::Measure m = L::measure_of_nothing();
    for (int n = 0; n < forward_springs; ++n) {
        const SheetNeighbour& neighbour = forward_neighbours[n];
        if (block.row + neighbour.row_offset >= static_cast<std::ptrdiff_t>(a.layout->rows)) continue;
        const auto k = static_cast<std::size_t>(neighbour.spring_class);
        const Vector other =
            load(a.position, block.offset + neighbour.row_offset * stride + neighbour.column_offset);
        const L::Measure with =
            L::measure_spring(m, x, other, Number(c.rest_lengths[neighbour.rest]), Number(c.stiffness[k]),
                              neighbour.spring_class == SpringClass::bend ? never : always);
        const L::mask exists = lanes_on_sheet(block.column + neighbour.column_offset,
                                              static_cast<std::ptrdiff_t>(a.layout->columns));
        m = block.interior ? with : chosen(exists, with, m);
    }
    return m;
}

/// Adds the measures of a pack's nodes themselves. `node` is the first; lanes after the last node are
/// undefined.
inline L::Measure with_nodes(const MeasureArguments& a, L::Measure m, std::size_t node, std::ptrdiff_t offset,
                             const Vector& x)
{
    const StepConstants<float>& c = *a.constants;
    float masses[width] = {};
    for (std::size_t k = 0; k < static_cast<std::size_t>(width) && node + k < a.node_count; ++k)
        masses[k] = static_cast<float>(a.masses[node + k]);
    m = L::measure_node(m, x, load(a.velocity, offset), Number::load(masses),
                        spread_vector<Number>(c.gravity_direction));
    const L::mask free = Number::load(a.inverse_mass + offset) > Number(0.0f);
    for (std::size_t k = 0; k < a.collider_count; ++k) {
        const Number gap = L::collider_gap(spread_collider<L::Collider, Number>(a.colliders[k]), x).w;
        m.max_penetration =
            L::choose(free, L::largest(Number(c.thickness) - gap, m.max_penetration), m.max_penetration);
    }
    return m;
}

/// The fixed tree over the first `count` measures of a block, by adding halves. Below the width of a pack,
/// lanes after the half are undefined.
inline void merge_block(BlockMeasures& measures, std::size_t count, float* to)
{
    for (std::size_t k = count; k < block_size; k += width) measures.set(k, L::measure_of_nothing());
    for (std::size_t half = block_size / 2; half > 0; half /= 2)
        for (std::size_t k = 0; k < half; k += width)
            measures.set(k, L::measure_merge(measures.at(k), measures.at(k + half)));
    for (int n = 0; n < BlockMeasures::numbers; ++n) to[n] = measures.values[n][0];
}

PLIANT_IN_ONE_PIECE void sheet_measure(const MeasureArguments& a, std::size_t first_block,
                                       std::size_t end_block)
{
    const std::size_t columns = a.layout->columns;
    BlockMeasures measures;
    for (std::size_t block = first_block; block < end_block; ++block) {
        const std::size_t first = block * block_size;
        const std::size_t end = first + block_size < a.node_count ? first + block_size : a.node_count;
        // Pieces of rows, in order: the next piece overwrites what a pack writes beyond the end of its own.
        for (std::size_t node = first; node < end;) {
            const std::size_t row = node / columns,
                              row_end = (row + 1) * columns < end ? (row + 1) * columns : end;
            for (; node < row_end; node += width) {
                const auto column = static_cast<std::ptrdiff_t>(node - row * columns);
                const auto r = static_cast<std::ptrdiff_t>(row);
                const bool interior =
                    column >= 1 && column + width + 2 <= static_cast<std::ptrdiff_t>(columns);
                const Block pack{r, column, offset_of(*a.layout, r, column), interior};
                const Vector x = load(a.position, pack.offset);
                measures.set(node - first, with_nodes(a, measured_springs(a, pack, x), node, pack.offset, x));
            }
            node = row_end;
        }
        merge_block(measures, end - first, a.measures + block * BlockMeasures::numbers);
    }
}

PLIANT_IN_ONE_PIECE void mesh_measure(const MeasureArguments& a, std::size_t first_block,
                                      std::size_t end_block)
{
    const MeasuredSlices& springs = a.springs;
    BlockMeasures measures;
    for (std::size_t block = first_block; block < end_block; ++block) {
        const std::size_t first = block * block_size;
        const std::size_t end = first + block_size < a.node_count ? first + block_size : a.node_count;
        for (std::size_t node = first; node < end; node += width) {
            const std::size_t slice = node / Slices::lanes, lane = node % Slices::lanes;
            const std::ptrdiff_t offset = offset_of(*a.layout, 0, static_cast<std::ptrdiff_t>(node));
            const Vector x = load(a.position, offset);
            L::Measure m = L::measure_of_nothing();
            for (std::uint32_t r = springs.start[slice]; r < springs.start[slice + 1]; ++r) {
                const std::size_t row = r * Slices::lanes + lane;
                const Vector other = gather_vectors(a.state, springs.place + row);
                const Number rest = Number::load(springs.rest_length + row);
                L::Measure with = L::measure_spring(m, x, other, rest, Number::load(springs.stiffness + row),
                                                    Number::load(springs.counts + row) > Number(0.0f));
                with.elastic_energy =
                    with.elastic_energy + L::bending_energy(x, other, Number::load(springs.bending + row));
                m = chosen(rest < Number(0.0f), m, with);
            }
            measures.set(node - first, with_nodes(a, m, node, offset, x));
        }
        merge_block(measures, end - first, a.measures + block * BlockMeasures::numbers);
    }
}
