#include "backend/cpu/cpu_body.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "backend/cpu/jobs.hpp"
#include "backend/cpu/pointers.hpp"
#include "backend/cpu/slices.hpp"

namespace pliant::cpu {
namespace {

using L = Laws<float>;

/// Adds the lanes of a block, in order.
template <class Value, class Merge>
Value total_of(const LaneSums& sums, Value (*value)(const float*), Merge merge)
{
    Value total{};
    for (std::size_t lane = 0; lane < Slices::lanes; ++lane) {
        float numbers[body_sum_count];
        for (std::size_t k = 0; k < body_sum_count; ++k) numbers[k] = sums.lanes[k][lane];
        total = lane == 0 ? value(numbers) : merge(total, value(numbers));
    }
    return total;
}

L::VolumeRate rate_from(const float* n) { return {n[0], n[1], {n[2], n[3], n[4]}, {n[5], n[6], n[7]}}; }
L::VolumeCubic cubic_from(const float* n) { return {n[0], n[1], n[2], n[3], n[4], {n[5], n[6], n[7]}}; }

}  // namespace

template <class Row>
CpuBody::SliceArrays CpuBody::sliced(const std::vector<BodyBlock>& blocks, const NodeLayout& layout,
                                     bool springs, Row row)
{
    SliceArrays slices;
    std::vector<std::vector<Entry>> rows(Slices::lanes);
    for (const BodyBlock& block : blocks)
        for (std::uint32_t first = 0; first < block_size; first += Slices::lanes) {
            for (std::uint32_t lane = 0; lane < Slices::lanes; ++lane)
                rows[lane] =
                    first + lane < block.count ? row(block.first + first + lane) : std::vector<Entry>{};
            append_slice(
                slices.start, [&](std::size_t lane) { return rows[lane].size(); },
                [&](std::size_t lane, std::size_t k, bool exists) {
                    // A short row repeats its last entry without a spring, which adds nothing.
                    const std::vector<Entry>& of = rows[lane];
                    const Entry entry = exists ? of[k] : Entry{of.empty() ? block.first : of.back().node, -1};
                    slices.place.push_back(
                        static_cast<std::uint32_t>(layout.offset(entry.node) * state_size));
                    if (springs) slices.rest_length.push_back(entry.rest_length);
                });
        }
    return slices;
}

CpuBody::CpuBody(const PlainCloth<float>& cloth)
{
    if (!cloth.model.body) return;
    const BodyModel& body = *cloth.model.body;
    const auto entries_of = [&](std::span<const Neighbour> row) {
        std::vector<Entry> entries;
        for (const Neighbour& n : row)
            entries.push_back({n.node, static_cast<float>(cloth.model.springs.list[n.spring].rest_length)});
        return entries;
    };
    ring_ = sliced(body.node_blocks, cloth.layout, true,
                   [&](std::size_t node) { return entries_of(cloth.model.ring_of(node)); });
    links_ = sliced(body.node_blocks, cloth.layout, true,
                    [&](std::size_t node) { return entries_of(cloth.model.links_of(node)); });
    fans_ = sliced(body.fan_blocks, cloth.layout, false, [&](std::size_t fan) {
        std::vector<Entry> entries;
        for (const std::uint32_t node : body.fans.row(fan)) entries.push_back({node, 0});
        return entries;
    });
    has_links_ = !links_.place.empty();
    any_blocked_.resize(body.node_blocks.size(), 0);
    numbers_.resize(body.parts.size());
    sums_.resize(std::max(body.node_blocks.size(), body.fan_blocks.size()));
}

bool CpuBody::has_kernel(Pass pass)
{
    return is_body_pass(pass) && unit_of(pass) != PassUnit::load && unit_of(pass) != PassUnit::body;
}

std::size_t CpuBody::size_of(const Call& call) const
{
    const bool fans = unit_of(call.pass) == PassUnit::fan_block;
    const SliceArrays& slices = fans ? fans_ : ring_;
    return (slices.start.size() - 1) / (block_size / Slices::lanes);
}

void CpuBody::prepare(const Call& call, PlainCloth<float>& cloth, const StepConstants<float>& constants)
{
    const DenormalsFlushed flushed;
    PlainBody<float>& plain = cloth.body;
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
        BodyNumbers& numbers = numbers_[k];
        const BodyPart& part = plain.model->parts[k];
        const VolumeGoal goal = plain.goal_of(call, constants, k);
        numbers.centre = plain.records[k].centre;
        numbers.pressure = static_cast<float>(goal.pressure);
        if (call.pass == Pass::volume_step)
            std::tie(numbers.mean, numbers.multiplier) = plain.multiplier_of(part, k, goal, constants);
        else if (call.pass == Pass::volume_correct)
            numbers.multiplier = plain.correction_of(part, k, goal);
    }
}

void CpuBody::run(const Call& call, PlainCloth<float>& cloth, StateRecords& records, const Kernels& kernels,
                  const StepConstants<float>& constants, std::span<const Laws<float>::Collider> colliders,
                  std::size_t begin, std::size_t end)
{
    const std::uint32_t now = call.parity, next = 1 - now;
    const bool fans = unit_of(call.pass) == PassUnit::fan_block;
    PlainBody<float>& plain = cloth.body;
    const BodyModel& model = *plain.model;
    BodyArguments a{};
    a.position = pointers(std::as_const(cloth.position[now]));
    a.velocity = pointers(std::as_const(cloth.velocity[now]));
    a.next_position = pointers(cloth.position[next]);
    a.next_velocity = pointers(cloth.velocity[next]);
    if (cloth.model.has_external_force()) a.external_force = pointers(std::as_const(cloth.external_force));
    a.state = records.at(now);
    a.next_state = records.at(next);
    a.ends = records.at(StateRecords::ends);
    a.gradient = pointers(plain.gradient);
    a.direction = pointers(plain.direction);
    a.blocked = pointers(plain.blocked);
    a.blocked_count = plain.blocked_count.data();
    a.inverse_mass = cloth.inverse_mass.data();
    a.weight = model.weights.empty() ? nullptr : plain.weight.data();
    a.any_blocked = any_blocked_.data();
    a.first_offset = cloth.layout.offset(0);
    a.blocks = (fans ? model.fan_blocks : model.node_blocks).data();
    a.ring = ring_.view();
    a.links = links_.view();
    a.fans = fans_.view();
    a.numbers = numbers_.data();
    a.sums = sums_.data();
    a.has_links = has_links_;
    a.has_pressure = model.has_pressure;
    a.measures = call.pass == Pass::volume_measure;
    a.constants = &constants;
    a.colliders = colliders.data();
    a.collider_count = colliders.size();
    switch (call.pass) {
        case Pass::ring_step: return kernels.ring_step(a, begin, end);
        case Pass::volume_step: return kernels.volume_step(a, begin, end);
        case Pass::volume_correct: return kernels.volume_correct(a, begin, end);
        case Pass::volume_gather:
            kernels.volume_gather(a, begin, end);
            for (std::size_t b = begin; b < end; ++b)
                plain.rates[b] =
                    total_of(sums_[b], rate_from, [](const L::VolumeRate& p, const L::VolumeRate& q) {
                        return L::volume_rate_merge(p, q);
                    });
            return;
        default:
            kernels.volume_cubic(a, begin, end);
            for (std::size_t b = begin; b < end; ++b)
                plain.cubics[b] =
                    total_of(sums_[b], cubic_from, [](const L::VolumeCubic& p, const L::VolumeCubic& q) {
                        return L::volume_cubic_merge(p, q);
                    });
    }
}

}  // namespace pliant::cpu
