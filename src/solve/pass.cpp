#include "solve/pass.hpp"

#include <array>

namespace pliant {
namespace {

using enum Resource;
using enum PassSize;

// READS and WRITES of each pass, stored once.
#define READS(...) std::to_array<Resource>({__VA_ARGS__})
#define WRITES(...) std::to_array<Resource>({__VA_ARGS__})
#define PASS(name, size, reads, writes)  \
    constexpr auto name##_reads = reads; \
    constexpr auto name##_writes = writes;
#include "solve/passes.def"
#undef PASS

constexpr PassDescription passes[] = {
#define PASS(name, size, reads, writes) {#name, size, name##_reads, name##_writes},
#include "solve/passes.def"
#undef PASS
};

}  // namespace

const PassDescription& description_of(Pass pass) { return passes[static_cast<std::size_t>(pass)]; }

std::span<const PassDescription> all_passes() { return passes; }

// Not in the header: what compiles wide kernels must leave no function that other files might take.
SumSlots sum_slots_of(Pass pass)
{
    switch (pass) {
        case Pass::mesh_springs: return {sum_spring_energy, 1};
        case Pass::mesh_gather: return {sum_node_energy, 2};     // and of contact
        case Pass::sheet_gather: return {sum_spring_energy, 3};  // and both of these
        case Pass::mesh_apply:
        case Pass::linear_apply: return {sum_curvature, 1};
        case Pass::linear_begin:
        case Pass::linear_update: return {sum_linear_residual2, 1};
        case Pass::linear_jacobi:
        case Pass::linear_plain:
        case Pass::mesh_smooth:
        case Pass::level_smooth: return {sum_rho, 1};
        case Pass::acad_begin: return {sum_load, 1};
        case Pass::step_begin: return {sum_load, 2};  // and the way
        case Pass::mesh_limits:
        case Pass::sheet_limits: return {sum_active, 2};  // and how far beyond
        case Pass::sheet_marks: return {sum_active, 2};   // and marked springs
        case Pass::mesh_multiply:
        case Pass::sheet_multiply: return {sum_renewed, 1};
        case Pass::contact_change: return {sum_contact_change, 1};
        case Pass::step_end: return {sum_lost, 2};  // and active constraints
        case Pass::paper_springs: return {sum_active, 1};
        case Pass::paper_apply: return {sum_curvature, 1};
        case Pass::paper_system: return {sum_linear_residual2, 1};
        case Pass::paper_update: return {sum_linear_residual2, 2};
        default: return {};
    }
}

bool is_of_live_rows(Pass pass)
{
    switch (pass) {
        case Pass::sheet_limits:
        case Pass::mesh_limits:
        case Pass::sheet_marks:
        case Pass::mesh_marks:
        case Pass::sheet_multipliers:
        case Pass::mesh_multipliers: return false;
        default: break;
    }
    switch (description_of(pass).size) {
        case PassSize::level:
        case PassSize::cell:
        case PassSize::edge:
        case PassSize::finer: return !is_paper_pass(pass);
        default: return false;
    }
}

MeasureTree::MeasureTree(std::uint32_t node_count)
{
    const auto blocks = [](std::uint32_t n) { return (n + block_size - 1) / block_size; };
    for (std::uint32_t count = blocks(node_count);; count = blocks(count)) {
        levels.push_back({value_count, count});
        value_count += count;
        if (count <= 1) return;
    }
}

}  // namespace pliant
