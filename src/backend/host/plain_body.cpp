#include "backend/host/plain_body.hpp"

#include <algorithm>
#include <tuple>

#include "backend/host/plain_cloth.hpp"

namespace pliant {
namespace {

static_assert(BodyBlock::most == block_size, "a block is what one work group sums up");

/// The force of a node's springs, and its volume gradient, summed in the order of the ring.
template <class T>
struct RingSums {
    Vector3<T> force{T(0), T(0), T(0)}, gradient{T(0), T(0), T(0)};

    RingSums(const PlainCloth<T>& cloth, const StepConstants<T>& c, std::uint32_t parity, std::size_t node)
    {
        using L = Laws<T>;
        const ClothModel& model = cloth.model;
        const std::size_t offset = cloth.layout.offset(node);
        const auto &positions = cloth.position[parity], &velocities = cloth.velocity[parity];
        const Vector3<T> x = positions.get(offset), v = velocities.get(offset);
        const auto add_spring = [&](const Neighbour& neighbour) {
            const Spring& spring = model.springs.list[neighbour.spring];
            const auto k = static_cast<std::size_t>(spring.spring_class);
            const std::size_t other = cloth.layout.offset(neighbour.node);
            force = force + L::spring_force(x, positions.get(other), v, velocities.get(other),
                                            static_cast<T>(spring.rest_length), c.stiffness[k], c.damping[k]);
        };
        const auto ring = model.ring_of(node);
        Vector3<T> first{T(0), T(0), T(0)}, before = first;
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const Vector3<T> side = positions.get(cloth.layout.offset(ring[k].node)) - x;
            add_spring(ring[k]);
            if (k == 0)
                first = side;
            else
                gradient = L::ring_add(gradient, before, side);
            before = side;
        }
        gradient = L::ring_add(gradient, before, first);
        for (const Neighbour& neighbour : model.links_of(node)) add_spring(neighbour);
    }
};

/// The fixed tree: 16 lanes, each the sum of every 16th value in order; then the lanes in order. Merging an
/// empty value changes no bit, so `count` may be less than 256.
template <class Value, class Merge>
Value merged_values(const Value* values, std::size_t count, Merge merge)
{
    constexpr std::size_t lane_count = 16;
    const std::size_t used = std::min(count, lane_count);
    Value total = values[0];
    for (std::size_t k = 0; k < used; ++k) {
        Value lane = values[k];
        for (std::size_t j = k + lane_count; j < count; j += lane_count) lane = merge(lane, values[j]);
        total = k == 0 ? lane : merge(total, lane);
    }
    return total;
}

/// Merges the blocks of a body: value k of 256 is the sum of the k-th, the (k + 256)-th, ...
template <class Value, class Nothing, class Merge>
Value merged_blocks(const std::vector<Value>& all, std::size_t first, std::size_t count, Nothing nothing,
                    Merge merge)
{
    Value values[block_size];
    std::fill(values, values + block_size, nothing());
    const std::size_t used = std::min<std::size_t>(block_size, count);
    for (std::size_t k = 0; k < used; ++k) {
        for (std::size_t source = k; source < count; source += block_size)
            values[k] = merge(values[k], all[first + source]);
    }
    return merged_values(values, used, merge);
}

}  // namespace

template <class T>
PlainBody<T>::PlainBody(const ClothModel& cloth, const NodeLayout& layout)
    : model(cloth.body ? &*cloth.body : nullptr)
{
    if (!model) return;
    for (Planes<T>* planes : {&gradient, &direction, &blocked}) *planes = Planes<T>(layout.size);
    node_count = cloth.node_count();
    blocked_count = AlignedArray<T>(layout.size);
    weight = AlignedArray<T>(layout.size);
    for (std::size_t i = 0; i < cloth.node_count(); ++i)
        weight[layout.offset(i)] = static_cast<T>(model->weight_of(i));
    rates.assign(model->node_blocks.size(), L::volume_rate_of_nothing());
    cubics.assign(model->fan_blocks.size(), L::volume_cubic_of_nothing());
    for (const BodyPart& part : model->parts) {
        records.push_back(
            {{static_cast<T>(part.centre.x), static_cast<T>(part.centre.y), static_cast<T>(part.centre.z)},
             static_cast<T>(6 * part.volume)});
        volumes.push_back(records.back().volume);
    }
}

template <class T>
std::size_t PlainBody<T>::size_of(const Call& call) const
{
    switch (unit_of(call.pass)) {
        case PassUnit::load: return model->loads.size();
        case PassUnit::node: return node_count;
        case PassUnit::fan_block: return model->fan_blocks.size();
        case PassUnit::body: return model->parts.size();
        default: return model->node_blocks.size();
    }
}

template <class T>
void PlainBody<T>::run(const Call& call, PlainCloth<T>& cloth, const StepConstants<T>& constants,
                       std::span<const Collider> colliders, std::size_t begin, std::size_t end)
{
    switch (call.pass) {
        case Pass::load_force: return load_force(call, cloth, begin, end);
        case Pass::ring_step: return ring_step(call, cloth, constants, colliders, begin, end);
        case Pass::volume_gather: return gather(call, cloth, constants, begin, end);
        case Pass::volume_step: return step(call, cloth, constants, colliders, begin, end);
        case Pass::volume_cubic:
        case Pass::volume_measure: return sum_fans(call, cloth, begin, end);
        case Pass::volume_correct: return correct(call, cloth, constants, begin, end);
        case Pass::volume_total:
            for (std::size_t k = begin; k < end; ++k) {
                const Cubic total = cubic_of(model->parts[k]);
                volumes[k] = total.volume + total.low;
            }
            return;
#define BODY_PASS(name, ...)
#define PASS(name, ...) \
    case Pass::name: {  \
        return;         \
    }
#include "solve/passes.def"
    }
}

template <class T>
typename PlainBody<T>::Rate PlainBody<T>::rate_of(const BodyPart& part) const
{
    return merged_blocks(rates, part.first_block, part.block_count, L::volume_rate_of_nothing,
                         [](const Rate& a, const Rate& b) { return L::volume_rate_merge(a, b); });
}

template <class T>
typename PlainBody<T>::Cubic PlainBody<T>::cubic_of(const BodyPart& part) const
{
    return merged_blocks(cubics, part.first_fan_block, part.fan_block_count, L::volume_cubic_of_nothing,
                         [](const Cubic& a, const Cubic& b) { return L::volume_cubic_merge(a, b); });
}

template <class T>
typename PlainBody<T>::Rate PlainBody<T>::merged(Rate* values)
{
    return merged_values(values, block_size,
                         [](const Rate& a, const Rate& b) { return L::volume_rate_merge(a, b); });
}

template <class T>
typename PlainBody<T>::Cubic PlainBody<T>::merged(Cubic* values)
{
    return merged_values(values, block_size,
                         [](const Cubic& a, const Cubic& b) { return L::volume_cubic_merge(a, b); });
}

template <class T>
VolumeGoal PlainBody<T>::goal_of(const Call& call, const StepConstants<T>& constants, std::size_t part) const
{
    const std::size_t parts = model->parts.size();
    if (constants.goals.size() < parts) return model->goal_at(part, 0);
    const std::size_t row = constants.goals.size() >= (call.index + 1) * parts ? call.index : 0;
    return constants.goals[row * parts + part];
}

template <class T>
std::pair<Vector3<T>, T> PlainBody<T>::multiplier_of(const BodyPart& part, std::size_t index,
                                                     const VolumeGoal& goal,
                                                     const StepConstants<T>& constants) const
{
    const Rate sums = rate_of(part);
    const Vector mean = L::volume_mean(sums, static_cast<T>(part.inverse_weight));
    const T excess = records[index].volume - static_cast<T>(goal.volume);
    return {mean, L::volume_multiplier(sums, mean, excess, constants.inverse_dt)};
}

template <class T>
T PlainBody<T>::correction_of(const BodyPart& part, const VolumeGoal& goal) const
{
    return L::volume_root(cubic_of(part), static_cast<T>(goal.volume));
}

template <class T>
T PlainBody<T>::correction_of(const BodyPart& part, std::size_t index, const VolumeGoal& goal)
{
    const T wanted = static_cast<T>(goal.volume);
    const Cubic cubic = cubic_of(part);
    const T s = L::volume_root(cubic, wanted);
    Record& record = records[index];
    record.volume = wanted + L::volume_excess(cubic, wanted, s);
    record.centre = record.centre + cubic.arm * static_cast<T>(part.inverse_fans);
    return s;
}

template <class T>
void PlainBody<T>::load_force(const Call& call, PlainCloth<T>& cloth, std::size_t begin,
                              std::size_t end) const
{
    const auto vector = [](Vec3d a) {
        return Vector{static_cast<T>(a.x), static_cast<T>(a.y), static_cast<T>(a.z)};
    };
    for (std::size_t k = begin; k < end; ++k) {
        const LoadedNode& load = model->loads[k];
        const std::size_t offset = cloth.layout.offset(load.node);
        const Vector force =
            L::region_force(vector(load.force), vector(load.torque), cloth.position[call.parity].get(offset));
        const bool wind =
            cloth.model.feels_air();  // if so, the wind pass has overwritten it; else it holds only this load
        cloth.external_force.set(offset, wind ? cloth.external_force.get(offset) + force : force);
    }
}

template <class T>
void PlainBody<T>::ring_step(const Call& call, PlainCloth<T>& cloth, const StepConstants<T>& c,
                             std::span<const Collider> colliders, std::size_t begin, std::size_t end) const
{
    std::size_t part = 0;
    for (std::size_t node = begin; node < end; ++node) {
        while (node >= model->parts[part].first_node + model->parts[part].node_count) ++part;
        const std::size_t offset = cloth.layout.offset(node);
        const RingSums<T> ring(cloth, c, call.parity, node);
        Vector force = ring.force + cloth.external_force_at(offset);
        if (model->has_pressure)
            force = force + ring.gradient * static_cast<T>(goal_of(call, c, part).pressure);
        cloth.finish_step(call, c, colliders, {node, 0, node, offset}, force);
    }
}

template <class T>
void PlainBody<T>::gather(const Call& call, PlainCloth<T>& cloth, const StepConstants<T>& c,
                          std::size_t begin, std::size_t end)
{
    for (std::size_t b = begin; b < end; ++b) {
        const BodyBlock& block = model->node_blocks[b];
        const T pressure = model->has_pressure ? static_cast<T>(goal_of(call, c, block.body).pressure) : T(0);
        Rate values[block_size];
        std::fill(values, values + block_size, L::volume_rate_of_nothing());
        for (std::uint32_t k = 0; k < block.count; ++k) {
            const std::size_t node = block.first + k, offset = cloth.layout.offset(node);
            const RingSums<T> ring(cloth, c, call.parity, node);
            Vector force = ring.force + cloth.external_force_at(offset);
            if (model->has_pressure) force = force + ring.gradient * pressure;
            const T w = cloth.inverse_mass[offset];
            const Vector next =
                L::velocity_step(cloth.velocity[call.parity].get(offset), force, w, c.gravity, c.decay, c.dt);
            gradient.set(offset, ring.gradient);
            cloth.velocity[1 - call.parity].set(offset, next);
            values[k] = L::volume_rate_of(ring.gradient, next, w, weight[offset], blocked_at(offset));
        }
        rates[b] = merged(values);
    }
}

template <class T>
void PlainBody<T>::step(const Call& call, PlainCloth<T>& cloth, const StepConstants<T>& c,
                        std::span<const Collider> colliders, std::size_t begin, std::size_t end)
{
    const Planes<T>& x = cloth.position[call.parity];
    Planes<T>&next_x = cloth.position[1 - call.parity], &next_v = cloth.velocity[1 - call.parity];
    std::size_t known = model->parts.size();
    Vector mean{T(0), T(0), T(0)};
    T q{};
    for (std::size_t b = begin; b < end; ++b) {
        const BodyBlock& block = model->node_blocks[b];
        if (block.body != known) {
            known = block.body;
            std::tie(mean, q) = multiplier_of(model->parts[known], known, goal_of(call, c, known), c);
        }
        for (std::uint32_t k = 0; k < block.count; ++k) {
            const std::size_t offset = cloth.layout.offset(block.first + k);
            const T w = cloth.inverse_mass[offset];
            const Vector g = gradient.get(offset);
            const typename L::Motion now = {x.get(offset), cloth.velocity[call.parity].get(offset)};
            typename L::Motion next;
            next.velocity = L::volume_velocity(next_v.get(offset), g, mean, w, weight[offset], q);
            next.position = L::position_step(now.position, next.velocity, c.dt);
            typename L::Blocked held = L::blocked_by_nothing();
            for (const Collider& collider : colliders) {
                held = L::blocked_with(held, collider, next.position, c.thickness, w);
                next = L::contact_step(now, next, collider, c.thickness, w, c.dt);
            }
            next_x.set(offset, next.position);
            next_v.set(offset, next.velocity);
            blocked.set(offset, held.normal);
            blocked_count[offset] = held.count;
            direction.set(offset, L::volume_direction(g, mean, w, weight[offset], held));
        }
    }
}

/// The cubic at the end of the step, or, for volume_measure, the volume of the current state.
template <class T>
void PlainBody<T>::sum_fans(const Call& call, const PlainCloth<T>& cloth, std::size_t begin, std::size_t end)
{
    const bool measures = call.pass == Pass::volume_measure;
    const Planes<T>& x = cloth.position[measures ? call.parity : 1 - call.parity];
    const Vector nothing{T(0), T(0), T(0)};
    const auto change_of = [&](std::size_t offset) { return measures ? nothing : direction.get(offset); };
    for (std::size_t b = begin; b < end; ++b) {
        const BodyBlock& block = model->fan_blocks[b];
        Cubic values[block_size];
        std::fill(values, values + block_size, L::volume_cubic_of_nothing());
        for (std::uint32_t k = 0; k < block.count; ++k) {
            const auto fan = model->fans.row(block.first + k);
            const std::size_t apex = cloth.layout.offset(fan[0]);
            const Vector a = x.get(apex), da = change_of(apex);
            typename L::FanSums sums = L::fan_of_nothing();
            Vector side = nothing, change = nothing;
            for (std::size_t i = 1; i < fan.size(); ++i) {
                const std::size_t other = cloth.layout.offset(fan[i]);
                const Vector next_side = x.get(other) - a, next_change = change_of(other) - da;
                if (i > 1) sums = L::fan_add(sums, side, next_side, change, next_change);
                side = next_side;
                change = next_change;
            }
            values[k] = L::fan_cubic(sums, a - records[block.body].centre, da);
            if (measures)
                values[k].first = values[k].second = values[k].third = T(0);  // avoids negative zeros
        }
        cubics[b] = merged(values);
    }
}

template <class T>
void PlainBody<T>::correct(const Call& call, PlainCloth<T>& cloth, const StepConstants<T>& c,
                           std::size_t begin, std::size_t end)
{
    Planes<T>&x = cloth.position[1 - call.parity], &v = cloth.velocity[1 - call.parity];
    std::size_t known = model->parts.size();
    T s{};
    for (std::size_t b = begin; b < end; ++b) {
        const BodyBlock& block = model->node_blocks[b];
        const BodyPart& part = model->parts[block.body];
        if (block.body != known) {
            known = block.body;
            const VolumeGoal goal = goal_of(call, c, known);
            s = b == part.first_block ? correction_of(part, known, goal) : correction_of(part, goal);
        }
        for (std::uint32_t k = 0; k < block.count; ++k) {
            const std::size_t offset = cloth.layout.offset(block.first + k);
            const typename L::Motion end_of_step =
                L::volume_corrected({x.get(offset), v.get(offset)}, direction.get(offset), s, c.inverse_dt);
            x.set(offset, end_of_step.position);
            v.set(offset, end_of_step.velocity);
        }
    }
}

template <class T>
void PlainBody<T>::read(Resource resource, const NodeLayout& layout, std::vector<float>& values) const
{
    values.clear();
    if (!model) return;
    const auto push = [&](auto... numbers) { (values.push_back(static_cast<float>(numbers)), ...); };
    const auto push_planes = [&](const Planes<T>& planes) {
        for (std::size_t i = 0; i < node_count; ++i) {
            const Vector a = planes.get(layout.offset(i));
            push(a.x, a.y, a.z);
        }
    };
    switch (resource) {
        case Resource::gradient: return push_planes(gradient);
        case Resource::direction: return push_planes(direction);
        case Resource::blocked:
            for (std::size_t i = 0; i < node_count; ++i) {
                const auto held = blocked_at(layout.offset(i));
                push(held.normal.x, held.normal.y, held.normal.z, held.count);
            }
            return;
        case Resource::rate_sums:
            for (const Rate& a : rates)
                push(a.rate, a.mobility, a.pushed.x, a.pushed.y, a.pushed.z, a.thrust.x, a.thrust.y,
                     a.thrust.z);
            return;
        case Resource::cubic_sums:
            for (const Cubic& a : cubics)
                push(a.volume, a.low, a.first, a.second, a.third, a.arm.x, a.arm.y, a.arm.z);
            return;
        case Resource::bodies:
            for (const Record& a : records) push(a.centre.x, a.centre.y, a.centre.z, a.volume);
            return;
        case Resource::volumes:
            for (const T a : volumes) push(a);
            return;
        default: return;
    }
}

template class PlainBody<double>;
template class PlainBody<float>;

}  // namespace pliant
