// Kernels of soft bodies: included by kernels.inl, inside its unnamed namespace. A pack is W neighbouring
// nodes, or fans, of a slice of 16.

constexpr std::size_t slice_lanes = 16;  // as Slices::lanes
constexpr std::size_t slices_in_block = 16;

inline Vector vector_of(const Vector3<float>& a) { return {Number(a.x), Number(a.y), Number(a.z)}; }
inline L::Blocked load_blocked(const BodyArguments& a, std::size_t block, std::ptrdiff_t offset)
{
    if (!a.any_blocked[block]) return L::blocked_by_nothing();
    return {load(a.blocked, offset), Number::load(a.blocked_count + offset)};
}
inline Number load_weight(const BodyArguments& a, std::ptrdiff_t offset)
{
    return a.weight ? Number::load(a.weight + offset) : Number(1.0f);
}

/// Lanes of a pack that are within the block.
inline L::mask lanes_below(std::ptrdiff_t first, std::uint32_t count)
{
    return lanes_on_sheet(first, static_cast<std::ptrdiff_t>(count));
}

/// Loads only the lanes within the block: another thread may be writing the planes behind it.
inline Number load_some(const float* from, std::ptrdiff_t lanes)
{
    if (lanes >= width) return Number::load(from);
    float values[width] = {};
    for (std::ptrdiff_t k = 0; k < lanes; ++k) values[k] = from[k];
    return Number::load(values);
}
inline Vector load_some(const Vectors& from, std::ptrdiff_t offset, std::ptrdiff_t lanes)
{
    return {load_some(from.x + offset, lanes), load_some(from.y + offset, lanes),
            load_some(from.z + offset, lanes)};
}

/// Visits the packs of a block: f(slice, lane of the slice, place in the block, lanes within the block).
template <class Function>
inline void for_each_pack(const BodyBlock& block, Function&& f)
{
    for (std::size_t place = 0; place < block.count; place += width)
        f(place / slice_lanes, place % slice_lanes, place, static_cast<std::ptrdiff_t>(block.count - place));
}

/// Accumulators of the rings of a slice.
struct SliceRing {
    float force[3][slice_lanes], gradient[3][slice_lanes];

    Vector force_at(std::size_t lane) const { return at(force, lane); }
    Vector gradient_at(std::size_t lane) const { return at(gradient, lane); }
    static PLIANT_INLINE Vector at(const float (&of)[3][slice_lanes], std::size_t lane)
    {
        return {Number::load(of[0] + lane), Number::load(of[1] + lane), Number::load(of[2] + lane)};
    }
    static PLIANT_INLINE void set(float (&of)[3][slice_lanes], std::size_t lane, const Vector& a)
    {
        a.x.store(of[0] + lane);
        a.y.store(of[1] + lane);
        a.z.store(of[2] + lane);
    }
};

/// Adds a list's springs to the forces on a slice, of nodes from `offset` on, in the order of the list.
/// Entries that pad a row have a negative rest length and repeat the last neighbour, so they add nothing. If
/// the list is a ring, also accumulates the gradient of the volume.
template <bool with_gradient>
PLIANT_INLINE void add_springs(const BodyArguments& a, const Slices& list, std::size_t slice,
                               std::ptrdiff_t offset, float k, float damping, SliceRing& sums)
{
    constexpr std::uint32_t most_rows = SpringSweeps::most / slice_lanes;
    const Vector zero{Number(0.0f), Number(0.0f), Number(0.0f)};
    SpringSweeps sweeps;
    float first[3][slice_lanes] = {}, before[3][slice_lanes] = {};
    const std::uint32_t begin = list.start[slice], end = list.start[slice + 1];
    for (std::uint32_t from = begin; from < end; from += most_rows) {
        const std::uint32_t rows = end - from < most_rows ? end - from : most_rows;
        for (std::size_t lane = 0; lane < slice_lanes; lane += width) {
            const auto place = offset + static_cast<std::ptrdiff_t>(lane);
            const Vector x = load(a.position, place), v = load(a.velocity, place);
            Vector gradient = zero, last = zero;
            if (with_gradient && from > begin)
                gradient = SliceRing::at(sums.gradient, lane), last = SliceRing::at(before, lane);
            for (std::uint32_t r = 0; r < rows; ++r) {
                const L::Motion there = gather_states(a.state, list.place + (from + r) * slice_lanes + lane);
                const Vector side = there.position - x;
                sweeps.set(r * slice_lanes + lane, side, there.velocity - v);
                if (!with_gradient) continue;
                if (from + r == begin)
                    SliceRing::set(first, lane, side);
                else
                    gradient = L::ring_add(gradient, last, side);
                last = side;
            }
            if (with_gradient) {
                if (from + rows == end) gradient = L::ring_add(gradient, last, SliceRing::at(first, lane));
                SliceRing::set(sums.gradient, lane, gradient);
                SliceRing::set(before, lane, last);
            }
        }
        sweeps.find_lengths(rows * slice_lanes);
        for (std::size_t lane = 0; lane < slice_lanes; lane += width) {
            Vector force = sums.force_at(lane);
            for (std::uint32_t r = 0; r < rows; ++r) {
                const Number rest = Number::load(list.rest_length + (from + r) * slice_lanes + lane);
                const Vector f = sweeps.force(r * slice_lanes + lane, rest, Number(k), Number(damping));
                force = force + L::choose(rest < Number(0.0f), zero, f);
            }
            SliceRing::set(sums.force, lane, force);
        }
    }
}

template <bool with_gradient>
PLIANT_INLINE void sum_ring(const BodyArguments& a, std::size_t slice, std::ptrdiff_t offset, SliceRing& sums)
{
    const StepConstants<float>& c = *a.constants;
    for (std::size_t lane = 0; lane < slice_lanes; lane += width)
        SliceRing::set(sums.force, lane, Vector{Number(0.0f), Number(0.0f), Number(0.0f)});
    add_springs<with_gradient>(a, a.ring, slice, offset, c.stiffness[0], c.damping[0], sums);
    if (a.has_links) add_springs<false>(a, a.links, slice, offset, c.stiffness[1], c.damping[1], sums);
}

template <bool with_gradient>
inline void step_block(const BodyArguments& a, std::size_t b)
{
    const BodyBlock& block = a.blocks[b];
    SliceRing ring{};
    for_each_pack(block, [&](std::size_t slice, std::size_t lane, std::size_t place, std::ptrdiff_t lanes) {
        const auto offset = static_cast<std::ptrdiff_t>(a.first_offset + block.first + place);
        if (lane == 0) sum_ring<with_gradient>(a, b * slices_in_block + slice, offset, ring);
        const L::Motion now = {load(a.position, offset), load(a.velocity, offset)};
        const Number w = Number::load(a.inverse_mass + offset);
        Vector force = ring.force_at(lane);
        if (a.external_force.x) force = force + load(a.external_force, offset);
        if (with_gradient) force = force + ring.gradient_at(lane) * Number(a.numbers[block.body].pressure);
        const L::Motion next = stepped(a, now, force, w);
        store_some(a.next_position, offset, next.position, lanes);
        store_some(a.next_velocity, offset, next.velocity, lanes);
        store_records(a.next_state, offset, next.position, next.velocity, lanes);
    });
}

PLIANT_IN_ONE_PIECE void ring_step(const BodyArguments& a, std::size_t first_block, std::size_t end_block)
{
    for (std::size_t b = first_block; b < end_block; ++b)
        if (a.has_pressure)
            step_block<true>(a, b);
        else
            step_block<false>(a, b);
}

/// Sums of one block in 16 lanes: lane k adds the values k, k + 16, ... in order.
template <class Value, class Merge>
class LaneTotals {
public:
    LaneTotals(const Value& nothing, Merge merge) : nothing_(nothing), merge_(merge) {}
    void add(std::size_t slice, std::size_t lane, const Value& value)
    {
        Value& total = totals_[lane / width];
        total = slice == 0 ? value : merge_(total, value);
    }
    /// Pads with neutral values: packs missing in the last slice, and slices missing in the block.
    template <class Store>
    void finish(std::uint32_t count, Store store)
    {
        for (std::size_t group = 0; group < group_count; ++group) {
            const std::size_t slices = (count + slice_lanes - 1 - group * width) / slice_lanes;
            const bool any = group * width < count;
            Value total = any ? totals_[group] : nothing_;
            if (any && slices < slices_in_block) total = merge_(total, nothing_);
            store(group * width, total);
        }
    }

private:
    static constexpr std::size_t group_count = slice_lanes / width;
    Value totals_[group_count];
    Value nothing_;
    Merge merge_;
};

inline L::VolumeRate where(const L::mask& m, const L::VolumeRate& a)
{
    const Number zero(0.0f);
    const Vector none{zero, zero, zero};
    return {L::choose(m, a.rate, zero), L::choose(m, a.mobility, zero), L::choose(m, a.pushed, none),
            L::choose(m, a.thrust, none)};
}
inline L::VolumeCubic where(const L::mask& m, const L::VolumeCubic& a)
{
    const Number zero(0.0f);
    return {L::choose(m, a.volume, zero), L::choose(m, a.low, zero),
            L::choose(m, a.first, zero),  L::choose(m, a.second, zero),
            L::choose(m, a.third, zero),  L::choose(m, a.arm, {zero, zero, zero})};
}

PLIANT_IN_ONE_PIECE void volume_gather(const BodyArguments& a, std::size_t first_block, std::size_t end_block)
{
    const StepConstants<float>& c = *a.constants;
    const Vector gravity = spread_vector<Number>(c.gravity);
    const Number dt(c.dt), decay(c.decay);
    SliceRing ring{};
    for (std::size_t b = first_block; b < end_block; ++b) {
        const BodyBlock& block = a.blocks[b];
        LaneTotals totals(L::volume_rate_of_nothing(), [](const L::VolumeRate& p, const L::VolumeRate& q) {
            return L::volume_rate_merge(p, q);
        });
        for_each_pack(
            block, [&](std::size_t slice, std::size_t lane, std::size_t place, std::ptrdiff_t lanes) {
                const auto offset = static_cast<std::ptrdiff_t>(a.first_offset + block.first + place);
                const Vector v = load(a.velocity, offset);
                const Number w = Number::load(a.inverse_mass + offset);
                if (lane == 0) sum_ring<true>(a, b * slices_in_block + slice, offset, ring);
                const Vector gradient = ring.gradient_at(lane);
                Vector force = ring.force_at(lane);
                if (a.external_force.x) force = force + load(a.external_force, offset);
                if (a.has_pressure) force = force + gradient * Number(a.numbers[block.body].pressure);
                const Vector next = L::velocity_step(v, force, w, gravity, decay, dt);
                store_some(a.gradient, offset, gradient, lanes);
                store_some(a.next_velocity, offset, next, lanes);
                L::VolumeRate rate =
                    L::volume_rate_of(gradient, next, w, load_weight(a, offset), load_blocked(a, b, offset));
                if (lanes < width)
                    rate = where(lanes_below(static_cast<std::ptrdiff_t>(place), block.count), rate);
                totals.add(slice, lane, rate);
            });
        float(*out)[slice_lanes] = a.sums[b].lanes;
        totals.finish(block.count, [&](std::size_t lane, const L::VolumeRate& t) {
            const Number values[] = {t.rate,     t.mobility, t.pushed.x, t.pushed.y,
                                     t.pushed.z, t.thrust.x, t.thrust.y, t.thrust.z};
            for (std::size_t k = 0; k < body_sum_count; ++k) values[k].store(out[k] + lane);
        });
    }
}

PLIANT_IN_ONE_PIECE void volume_step(const BodyArguments& a, std::size_t first_block, std::size_t end_block)
{
    const StepConstants<float>& c = *a.constants;
    const Number dt(c.dt), thickness(c.thickness);
    for (std::size_t b = first_block; b < end_block; ++b) {
        const BodyBlock& block = a.blocks[b];
        const BodyNumbers& numbers = a.numbers[block.body];
        const Vector mean = vector_of(numbers.mean);
        const Number q(numbers.multiplier);
        const bool before = a.any_blocked[b] != 0;
        bool any = false;
        for_each_pack(block, [&](std::size_t, std::size_t, std::size_t place, std::ptrdiff_t lanes) {
            const auto offset = static_cast<std::ptrdiff_t>(a.first_offset + block.first + place);
            const Number w = Number::load(a.inverse_mass + offset), weight = load_weight(a, offset);
            const Vector gradient = load(a.gradient, offset);
            const L::Motion now = {load(a.position, offset), load(a.velocity, offset)};
            L::Motion next;
            next.velocity =
                L::volume_velocity(load_some(a.next_velocity, offset, lanes), gradient, mean, w, weight, q);
            next.position = L::position_step(now.position, next.velocity, dt);
            L::Blocked held = L::blocked_by_nothing();
            for (std::size_t k = 0; k < a.collider_count; ++k) {
                const L::Collider collider = spread_collider<L::Collider, Number>(a.colliders[k]);
                held = L::blocked_with(held, collider, next.position, thickness, w);
                next = L::contact_step(now, next, collider, thickness, w, dt);
            }
            store_some(a.next_position, offset, next.position, lanes);
            store_some(a.next_velocity, offset, next.velocity, lanes);
            const bool touches = L::any_lane(held.count > Number(0.0f));
            any = any || touches;
            if (touches || before) {
                store_some(a.blocked, offset, held.normal, lanes);
                store_some(a.blocked_count + offset, held.count, lanes);
            }
            const Vector direction = L::volume_direction(gradient, mean, w, weight, held);
            store_some(a.direction, offset, direction, lanes);
            store_records(a.ends, offset, next.position, direction, lanes);
        });
        a.any_blocked[b] = any;
    }
}

/// The fans of a pack: of the next state along the directions, or, if `measures`, of the current state.
template <bool measures>
inline L::VolumeCubic cubic_of_fans(const BodyArguments& a, std::size_t slice, std::size_t lane,
                                    const Vector& centre)
{
    const Vector zero{Number(0.0f), Number(0.0f), Number(0.0f)};
    const auto gather = [&](const std::uint32_t* offset) {
        if (measures) return L::Motion{gather_vectors(a.state, offset), zero};
        return gather_states(a.ends, offset);  // the direction takes the place of the velocity
    };
    const std::uint32_t begin = a.fans.start[slice], end = a.fans.start[slice + 1];
    const std::uint32_t* offset = a.fans.place + begin * slice_lanes + lane;
    const L::Motion apex = gather(offset);
    L::FanSums fan = L::fan_of_nothing();
    Vector side = zero, change = zero;
    for (std::uint32_t r = begin + 1; r < end; ++r) {
        offset += slice_lanes;
        const L::Motion corner = gather(offset);
        const Vector next_side = corner.position - apex.position,
                     next_change = corner.velocity - apex.velocity;
        if (r > begin + 1) fan = L::fan_add(fan, side, next_side, change, next_change);
        side = next_side;
        change = next_change;
    }
    L::VolumeCubic cubic = L::fan_cubic(fan, apex.position - centre, apex.velocity);
    if (measures) cubic.first = cubic.second = cubic.third = Number(0.0f);  // avoids negative zeros
    return cubic;
}

template <bool measures>
inline void sum_fans(const BodyArguments& a, std::size_t first_block, std::size_t end_block)
{
    for (std::size_t b = first_block; b < end_block; ++b) {
        const BodyBlock& block = a.blocks[b];
        const Vector centre = vector_of(a.numbers[block.body].centre);
        LaneTotals totals(L::volume_cubic_of_nothing(), [](const L::VolumeCubic& p, const L::VolumeCubic& q) {
            return L::volume_cubic_merge(p, q);
        });
        for_each_pack(
            block, [&](std::size_t slice, std::size_t lane, std::size_t place, std::ptrdiff_t lanes) {
                L::VolumeCubic cubic = cubic_of_fans<measures>(a, b * slices_in_block + slice, lane, centre);
                if (lanes < width)
                    cubic = where(lanes_below(static_cast<std::ptrdiff_t>(place), block.count), cubic);
                totals.add(slice, lane, cubic);
            });
        float(*out)[slice_lanes] = a.sums[b].lanes;
        totals.finish(block.count, [&](std::size_t lane, const L::VolumeCubic& t) {
            const Number values[] = {t.volume, t.low, t.first, t.second, t.third, t.arm.x, t.arm.y, t.arm.z};
            for (std::size_t k = 0; k < body_sum_count; ++k) values[k].store(out[k] + lane);
        });
    }
}

PLIANT_IN_ONE_PIECE void volume_cubic(const BodyArguments& a, std::size_t first_block, std::size_t end_block)
{
    if (a.measures)
        sum_fans<true>(a, first_block, end_block);
    else
        sum_fans<false>(a, first_block, end_block);
}

PLIANT_IN_ONE_PIECE void volume_correct(const BodyArguments& a, std::size_t first_block,
                                        std::size_t end_block)
{
    const Number inverse_dt(a.constants->inverse_dt);
    for (std::size_t b = first_block; b < end_block; ++b) {
        const BodyBlock& block = a.blocks[b];
        const Number s(a.numbers[block.body].multiplier);
        for_each_pack(block, [&](std::size_t, std::size_t, std::size_t place, std::ptrdiff_t lanes) {
            const auto offset = static_cast<std::ptrdiff_t>(a.first_offset + block.first + place);
            const L::Motion end = L::volume_corrected(
                {load_some(a.next_position, offset, lanes), load_some(a.next_velocity, offset, lanes)},
                load(a.direction, offset), s, inverse_dt);
            store_some(a.next_position, offset, end.position, lanes);
            store_some(a.next_velocity, offset, end.velocity, lanes);
            store_records(a.next_state, offset, end.position, end.velocity, lanes);
        });
    }
}
