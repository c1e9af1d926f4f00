// Kernels of meshes, and of sheets in the formulation spring_list: included by kernels.inl, inside its
// unnamed namespace.

/// Stores the first lanes only: other data may follow.
inline void store_some(float* to, const Number& a, std::ptrdiff_t lanes)
{
    if (lanes >= width) return a.store(to);
    float values[width];
    a.store(values);
    for (std::ptrdiff_t k = 0; k < lanes; ++k) to[k] = values[k];
}
inline void store_some(const Vectors& to, std::ptrdiff_t offset, const Vector& a, std::ptrdiff_t lanes)
{
    store_some(to.x + offset, a.x, lanes);
    store_some(to.y + offset, a.y, lanes);
    store_some(to.z + offset, a.z, lanes);
}

/// Gathers the vectors at `place`, in floats.
PLIANT_INLINE Vector gather_vectors(const float* records, const std::uint32_t* place)
{
    return vectors_from_quads<width>(
        [&](int lane) { return *reinterpret_cast<const Quad*>(records + place[lane]); });
}
PLIANT_INLINE L::Motion gather_states(const float* records, const std::uint32_t* place)
{
    return {gather_vectors(records, place), gather_vectors(records + vector_size, place)};
}
/// Stores the first vectors of a pack, `stride` floats apart.
template <std::size_t stride>
PLIANT_INLINE void store_vectors(float* records, const Vector& a, std::ptrdiff_t lanes)
{
    const auto store_lane = [&](int lane, const Quad& quad) {
        *reinterpret_cast<Quad*>(records + static_cast<std::size_t>(lane) * stride) = quad;
    };
    if (lanes >= width) return quads_from_vectors<width>(a, store_lane);
    quads_from_vectors<width>(a, [&](int lane, const Quad& quad) {
        if (lane < lanes) store_lane(lane, quad);
    });
}
/// Stores two vectors for each node from `offset` on.
PLIANT_INLINE void store_records(float* records, std::ptrdiff_t offset, const Vector& a, const Vector& b,
                                 std::ptrdiff_t lanes)
{
    float* to = records + static_cast<std::size_t>(offset) * state_size;
    store_vectors<state_size>(to, a, lanes);
    store_vectors<state_size>(to + vector_size, b, lanes);
}

/// Makes records in packs of 16 nodes, including padding.
PLIANT_IN_ONE_PIECE void record_states(const RecordArguments& a, std::size_t first, std::size_t end)
{
    for (std::size_t k = first; k < end; k += width) {
        const auto offset = static_cast<std::ptrdiff_t>(k);
        store_records(a.state, offset, load(a.position, offset), load(a.velocity, offset), width);
    }
}

/// The forces of springs, in three sweeps: differences of their ends, lengths, forces. Computed at once, a
/// spring is a dependency chain of a hundred cycles, and a core overlaps only two of these. The chains of a
/// sweep are short.
class SpringSweeps {
public:
    static constexpr std::size_t most = 128;  ///< springs per batch

    /// First sweep, for a pack: d = x_j - x_i and v_j - v_i.
    PLIANT_INLINE void set(std::size_t k, const Vector& d, const Vector& relative_velocity)
    {
        d.x.store(d_[0] + k);
        d.y.store(d_[1] + k);
        d.z.store(d_[2] + k);
        relative_velocity.x.store(relative_velocity_[0] + k);
        relative_velocity.y.store(relative_velocity_[1] + k);
        relative_velocity.z.store(relative_velocity_[2] + k);
        L::dot3(d, d).store(length2_ + k);
    }
    PLIANT_INLINE Vector difference(std::size_t k) const
    {
        return {Number::load(d_[0] + k), Number::load(d_[1] + k), Number::load(d_[2] + k)};
    }
    /// Second sweep, for `count` springs, a multiple of 16.
    PLIANT_INLINE void find_lengths(std::size_t count)
    {
        std::size_t k = 0;
        for (; k + 4 * width <= count; k += 4 * width) {  // four independent chains hide latency
            const Number a = L::inverse_sqrt(Number::load(length2_ + k)),
                         b = L::inverse_sqrt(Number::load(length2_ + k + width)),
                         c = L::inverse_sqrt(Number::load(length2_ + k + 2 * width)),
                         d = L::inverse_sqrt(Number::load(length2_ + k + 3 * width));
            a.store(inverse_length_ + k);
            b.store(inverse_length_ + k + width);
            c.store(inverse_length_ + k + 2 * width);
            d.store(inverse_length_ + k + 3 * width);
        }
        for (; k < count; k += width) L::inverse_sqrt(Number::load(length2_ + k)).store(inverse_length_ + k);
    }
    /// Third sweep, for a pack.
    PLIANT_INLINE Vector force(std::size_t k, const Number& rest_length, const Number& stiffness,
                               const Number& damping) const
    {
        const Vector relative_velocity{Number::load(relative_velocity_[0] + k),
                                       Number::load(relative_velocity_[1] + k),
                                       Number::load(relative_velocity_[2] + k)};
        return L::spring_pull(difference(k), relative_velocity, Number::load(length2_ + k),
                              Number::load(inverse_length_ + k), rest_length, stiffness, damping);
    }

private:
    float d_[3][most], relative_velocity_[3][most], length2_[most], inverse_length_[most];
};

PLIANT_IN_ONE_PIECE void spring_forces(const SpringArguments& a, std::size_t first, std::size_t end)
{
    const Vector zero{Number(0.0f), Number(0.0f), Number(0.0f)};
    SpringSweeps sweeps;
    for (std::size_t from = first; from < end; from += SpringSweeps::most) {
        const std::size_t count = end - from < SpringSweeps::most ? end - from : SpringSweeps::most;
        for (std::size_t k = 0; k < count; k += width) {
            const L::Motion i = gather_states(a.state, a.first + from + k),
                            j = gather_states(a.state, a.second + from + k);
            sweeps.set(k, j.position - i.position, j.velocity - i.velocity);
        }
        sweeps.find_lengths(count);
        for (std::size_t k = 0; k < count; k += width) {
            const std::size_t s = from + k;
            const Vector spring = sweeps.force(k, Number::load(a.rest_length + s),
                                               Number::load(a.stiffness + s), Number::load(a.damping + s));
            const Number weight = a.bending ? Number::load(a.bending + s) : Number(0.0f);
            const Vector bending = L::bending_force(zero, sweeps.difference(k), weight);
            store_vectors<vector_size>(a.force + s * vector_size, spring + bending, width);
        }
    }
}

PLIANT_IN_ONE_PIECE void list_step(const ListArguments& a, std::size_t first_slice, std::size_t end_slice)
{
    using Bits = LaneTypes<width>::Bits;
    /// The force of an entry in each lane, with its sign.
    const auto force_of = [&](const std::uint32_t* entry) {
        Vector f = vectors_from_quads<width>(
            [&](int lane) { return *reinterpret_cast<const Quad*>(a.force + (entry[lane] & ~1u)); });
        Bits sign;
        __builtin_memcpy(&sign, entry, sizeof sign);
        sign <<= 31;
        for (Number* number : {&f.x, &f.y, &f.z})
            number->lanes = reinterpret_cast<Number::Lanes>(reinterpret_cast<Bits>(number->lanes) ^ sign);
        return f;
    };
    for (std::size_t s = first_slice; s < end_slice; ++s)
        for (std::size_t lane = 0; lane < a.runs[s].count; lane += width) {
            const auto offset = static_cast<std::ptrdiff_t>(a.runs[s].offset + lane);
            const auto lanes = static_cast<std::ptrdiff_t>(a.runs[s].count - lane);
            Vector force{Number(0.0f), Number(0.0f), Number(0.0f)};
            for (std::uint32_t r = a.start[s]; r < a.start[s + 1]; ++r)
                force = force + force_of(a.springs + r * Slices::lanes + lane);
            if (a.external_force.x) force = force + load(a.external_force, offset);
            const L::Motion now = {load(a.position, offset), load(a.velocity, offset)};
            const Number w = Number::load(a.inverse_mass + offset);
            const L::Motion next = stepped(a, now, force, w);
            store_some(a.next_position, offset, next.position, lanes);
            store_some(a.next_velocity, offset, next.velocity, lanes);
            store_records(a.next_state, offset, next.position, next.velocity, lanes);
        }
}
