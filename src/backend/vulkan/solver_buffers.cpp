#include "backend/vulkan/solver_buffers.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <iterator>

#include "backend/vulkan/layout.hpp"

namespace pliant::vulkan {
namespace {

using Usage = vk::BufferUsageFlagBits;

constexpr std::size_t most_slots = 4 * std::size(SolverBlock{}.part_counts);
static_assert(sum_slot_count <= most_slots);

}  // namespace

std::string arena_refusal(const ClothModel& model, const std::string& device, std::uint64_t most)
{
    const std::uint64_t bytes = model.hierarchy.number_count * sizeof(float);
    if (bytes <= most) return {};
    // The size of the arena is proportional to the nodes, except for its border.
    return "the constraint solver of a cloth of " + std::to_string(model.node_count()) +
           " nodes takes a buffer of " + std::to_string(bytes) + " bytes, and on " + device +
           " the limit maxStorageBufferRange is " + std::to_string(most) + ", enough for about " +
           std::to_string(model.node_count() * most / bytes) +
           " nodes of this kind; use fewer nodes or another backend, for example --backend cpu";
}

SolverBuffers::SolverBuffers(const Device& device, const ClothModel& model) : model_(&model)
{
    const Hierarchy& hierarchy = model.hierarchy;
    if (hierarchy.empty()) return;
    const std::size_t bytes = hierarchy.number_count * sizeof(float);
    const std::string refusal = arena_refusal(model, device.info().name, device.info().max_buffer_range);
    if (!refusal.empty()) throw Error(ErrorKind::device_failure, refusal);
    if (hierarchy.level_count() > std::size_t{most_levels})
        throw Error(ErrorKind::device_failure,
                    "the constraint solver of a cloth has " + std::to_string(hierarchy.level_count()) +
                        " levels, and on Vulkan at most " + std::to_string(most_levels) +
                        "; use another backend, for example --backend cpu");

    const auto device_buffer = [&](std::size_t size, const char* name) {
        return device.make_buffer(size, Usage::eStorageBuffer, Memory::device, name);
    };
    constants_ =
        device.make_buffer(sizeof(SolverBlock), Usage::eUniformBuffer, Memory::upload, "solver constants");
    arena_ = device_buffer(bytes, "solver's numbers");
    {
        std::vector<float> numbers(hierarchy.number_count);
        set_first_numbers(model, hierarchy, numbers.data());
        device.write(arena_, numbers.data(), bytes);
    }
    const std::array<float, solver_scalar_count> zeros{};
    scalars_ = device_buffer(sizeof zeros, "solver's scalars");
    device.write(scalars_, zeros.data(), sizeof zeros);
    scalar_copy_ = device.make_buffer(sizeof zeros, Usage::eTransferDst, Memory::readback,
                                      "copy of the solver's scalars");
    std::memcpy(scalar_copy_.mapped, zeros.data(), sizeof zeros);

    sum_parts_ = SumParts(model, hierarchy);
    const std::vector<float> no_parts(static_cast<std::size_t>(sum_parts_.stride) * sum_slot_count);
    parts_ = device_buffer(no_parts.size() * sizeof(float), "parts of sums");
    device.write(parts_, no_parts.data(), no_parts.size() * sizeof(float));

    const std::vector<std::int32_t>& topology = hierarchy.topology;
    topology_ = device_buffer(topology.size() * sizeof(std::int32_t), "topology");
    device.write(topology_, topology.data(), topology.size() * sizeof(std::int32_t));
    const std::vector<float> nothing(model.node_count());
    multiplier_ = device_buffer(nothing.size() * sizeof(float), "multiplier");
    device.write(multiplier_, nothing.data(), nothing.size() * sizeof(float));
    set_constants(0);
}

Groups SolverBuffers::groups_on(std::int32_t rows, std::int32_t columns) const
{
    return {static_cast<std::uint64_t>(sum_groups(columns)), static_cast<std::uint64_t>(rows)};
}

Groups SolverBuffers::groups_of(const Call& call) const
{
    const std::vector<SolverLevel>& levels = model_->hierarchy.levels;
    const SolverLevel& level = levels[call.level];
    const SolverLevel& finer = levels[call.level > 0 ? call.level - 1 : 0];
    const ConstraintRows& rows = model_->hierarchy.constraints;
    switch (unit_of(call.pass)) {
        case PassUnit::single:
        case PassUnit::bottom: return {1, 1};
        case PassUnit::flag: return groups_on(1, std::max(level.node_units(), sum_groups(level.edges)));
        case PassUnit::edge:
        case PassUnit::live_edge: return groups_on(1, level.edges);
        case PassUnit::live_finer_node: return groups_on(1, finer.columns);
        case PassUnit::live_finer_cell: return groups_on((finer.rows + 1) / 2, (finer.columns + 1) / 2);
        case PassUnit::spring_row: return groups_on(1, static_cast<std::int32_t>(rows.springs));
        case PassUnit::constraint_row:
        case PassUnit::active_row: return groups_on(1, static_cast<std::int32_t>(rows.constraints));
        case PassUnit::row_block:
            return groups_on(1, static_cast<std::int32_t>(rows.scan_blocks(call.detail)));
        default: break;
    }
    return groups_on(level.rows, level.columns);
}

void SolverBuffers::set_constants(double step_length)
{
    const Hierarchy& hierarchy = model_->hierarchy;
    if (hierarchy.empty()) return;
    const auto c = make_solver_constants<float>(*model_, step_length);
    SolverBlock block{};
    block.step_contact = {c.dt, c.inverse_dt, c.contact_stiffness, c.slip};
    for (std::size_t k = 0; k < spring_class_count; ++k) {
        const auto& curve = c.curves[k];
        block.curves[k] = {curve.below, curve.limit, curve.beyond, curve.compressed};
        block.has[k] = c.has[k] ? 1 : 0;
        block.curve_kinds[k] = curve.kind;
    }
    block.curve_damping = {c.curves[0].damping, c.curves[1].damping, c.curves[2].damping, c.polish_reach};
    block.curve_reach = {c.curves[0].reach, c.curves[1].reach, c.curves[2].reach, c.acad_reach};
    std::copy(std::begin(c.relaxations), std::end(c.relaxations), &block.relaxations[0].x);
    block.tolerances = {c.linear_tolerance, c.newton_tolerance, c.enough_iterations, 1};
    for (std::size_t k = 0; k < spring_class_count; ++k) {
        block.softest[k] = c.softest[k];
        block.compliance[k] = c.compliance[k];
        block.remembers[k] = c.remembers[k] ? 1 : 0;
        if (c.remembers[k]) block.tolerances[3] = c.curves[k].kept;
        block.remembers[3] |= block.remembers[k];
    }
    block.softest[2] = c.softest_held;  // bend springs have no memory
    block.compliance[2] = c.softest_held_limit;
    block.softest[3] = c.softest_limit;
    block.compliance[3] = c.stiffest_limit;
    block.acad_above_below = {c.acad_above2, c.acad_below2, c.acad_held_above2, c.acad_held_below2};
    block.acad_near = {c.acad_near_above2, c.acad_near_below2, c.is_acad ? 1.0f : 0.0f,
                       c.acad_has_memory ? 1.0f : 0.0f};
    block.second_order = {c.short_dt, c.inverse_short_dt, c.third, c.air};
    block.history_plane = c.history_plane;
    block.has_damping = c.has_damping ? 1 : 0;
    block.exact_bend = c.exact_bend ? 1 : 0;
    block.is_graded = c.is_graded ? 1 : 0;
    block.contact_is_by_mass = c.contact_is_by_mass ? 1 : 0;
    block.bottom_base = hierarchy.bottom_base;
    block.part_stride = sum_parts_.stride;
    for (std::size_t k = 0; k < sum_parts_.counts.size(); ++k)
        block.part_counts[k / 4][k % 4] = sum_parts_.counts[k];
    for (std::size_t k = 0; k < hierarchy.level_count(); ++k) block.levels[k] = hierarchy.levels[k];
    std::memcpy(constants_.mapped, &block, sizeof block);
}

void SolverBuffers::record_scalar_copy(const vk::raii::CommandBuffer& commands) const
{
    commands.copyBuffer(*scalars_, *scalar_copy_, vk::BufferCopy(0, 0, solver_scalar_count * sizeof(float)));
}

bool SolverBuffers::skips(Guard guard) const { return scalar(static_cast<std::size_t>(guard)) != 0; }

double SolverBuffers::scalar(std::size_t number) const
{
    return scalar_copy_.mapped ? double{static_cast<const float*>(scalar_copy_.mapped)[number]} : 0;
}

}  // namespace pliant::vulkan
