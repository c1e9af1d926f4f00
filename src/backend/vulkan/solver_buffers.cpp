#include "backend/vulkan/solver_buffers.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "backend/host/solver_state.hpp"
#include "backend/vulkan/float4.hpp"

namespace pliant::vulkan {
namespace {

using Usage = vk::BufferUsageFlagBits;

constexpr std::int32_t group_columns = 64;  ///< of shaders/solver_nodes.glsl
constexpr std::size_t most_levels = 32;     ///< more halvings than a row of 2^31 nodes allows
constexpr std::size_t level_numbers = 24;   ///< integers that a level takes there
constexpr std::size_t most_slots = 16;
static_assert(sum_slot_count <= most_slots);
static_assert(group_columns == sum_columns);

// The order in which level_at() of shaders/solver.glsl reads them.
static_assert(sizeof(SolverLevel) <= level_numbers * sizeof(std::int32_t));
static_assert(offsetof(SolverLevel, size) == 4 * sizeof(std::int32_t));
static_assert(offsetof(SolverLevel, edge_ends) == 8 * sizeof(std::int32_t));
static_assert(offsetof(SolverLevel, held_start) == 10 * sizeof(std::int32_t));
static_assert(offsetof(SolverLevel, fold_start) == 19 * sizeof(std::int32_t));

/// As the uniform block of shaders/solver.glsl.
struct SolverBlock {
    Float4 step_contact;
    Float4 curves[spring_class_count];
    Float4 curve_damping, curve_reach;
    float relaxations[SolverConstants<float>::most_relaxations]{};
    float tolerances[4]{};
    float softest[4]{}, compliance[4]{};
    Float4 acad_above_below, acad_near, second_order;
    std::uint32_t has_damping = 0, exact_bend = 0, is_graded = 0, contact_is_by_mass = 0;
    std::uint32_t has[4]{}, remembers[4]{};
    std::int32_t curve_kinds[4]{};
    std::int32_t bottom_base = 0, part_stride = 0, history_plane = 0, padding = 0;
    std::int32_t part_counts[most_slots]{};
    std::int32_t levels[most_levels][level_numbers]{};
};
// What GLSL aligns to 16 bytes.
static_assert(offsetof(SolverBlock, has) % 16 == 0 && offsetof(SolverBlock, part_counts) % 16 == 0);

}  // namespace

std::string arena_refusal(const ClothModel& model, const std::string& device, std::uint64_t most)
{
    const std::uint64_t bytes = model.hierarchy.number_count * sizeof(float);
    if (bytes <= most) return {};
    // The arena grows as the nodes do, but for a border.
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
    if (hierarchy.level_count() > most_levels)
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

    const std::vector<float> no_parts(static_cast<std::size_t>(SumParts(model, hierarchy).stride) *
                                      sum_slot_count);
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
    switch (description_of(call.pass).size) {
        case PassSize::single: return {1, 1};
        case PassSize::live: return groups_on(1, std::max(level.node_units(), sum_groups(level.edges)));
        case PassSize::edge: return groups_on(1, level.edges);
        case PassSize::finer: return groups_on(1, finer.columns);
        case PassSize::row:
            return groups_on(1, static_cast<std::int32_t>(
                                    call.pass == Pass::paper_springs ? rows.springs : rows.constraints));
        case PassSize::scan: return groups_on(1, static_cast<std::int32_t>(rows.scan_blocks(call.detail)));
        case PassSize::cell:
            if (call.pass == Pass::sheet_prolong)
                return groups_on((finer.rows + 1) / 2, (finer.columns + 1) / 2);
            break;
        default: break;
    }
    return groups_on(level.rows, level.columns);
}

void SolverBuffers::set_constants(double step_length)
{
    const Hierarchy& hierarchy = model_->hierarchy;
    if (hierarchy.empty()) return;
    const auto c = make_solver_constants<float>(*model_, step_length);
    SolverBlock block;
    block.step_contact = {c.dt, c.inverse_dt, c.contact_stiffness, c.slip};
    for (std::size_t k = 0; k < spring_class_count; ++k) {
        const auto& curve = c.curves[k];
        block.curves[k] = {curve.below, curve.limit, curve.beyond, curve.compressed};
        block.has[k] = c.has[k] ? 1 : 0;
        block.curve_kinds[k] = curve.kind;
    }
    block.curve_damping = {c.curves[0].damping, c.curves[1].damping, c.curves[2].damping, c.polish_reach};
    block.curve_reach = {c.curves[0].reach, c.curves[1].reach, c.curves[2].reach, c.acad_reach};
    std::copy(std::begin(c.relaxations), std::end(c.relaxations), block.relaxations);
    block.tolerances[0] = c.linear_tolerance;
    block.tolerances[1] = c.newton_tolerance;
    block.tolerances[2] = c.enough_iterations;
    block.tolerances[3] = 1;
    for (std::size_t k = 0; k < spring_class_count; ++k) {
        block.softest[k] = c.softest[k];
        block.compliance[k] = c.compliance[k];
        block.remembers[k] = c.remembers[k] ? 1 : 0;
        if (c.remembers[k]) block.tolerances[3] = c.curves[k].kept;
        block.remembers[3] |= block.remembers[k];
    }
    block.softest[2] = c.softest_held;  // no bend spring remembers
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
    const SumParts sum_parts(*model_, hierarchy);
    block.part_stride = sum_parts.stride;
    std::copy(sum_parts.counts.begin(), sum_parts.counts.end(), block.part_counts);
    for (std::size_t k = 0; k < hierarchy.level_count(); ++k)
        std::memcpy(block.levels[k], &hierarchy.levels[k], sizeof(SolverLevel));
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
