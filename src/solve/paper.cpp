#include "solve/paper.hpp"

#include "solve/mass_spring.hpp"

namespace pliant {
namespace {

void append_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step, std::uint32_t parity,
                 std::vector<Call>& calls)
{
    const auto add = [&](Pass pass, Guard guard = Guard::none, std::uint32_t detail = 0) {
        calls.push_back({pass, index, parity, step, 0, detail, guard});
    };
    add(Pass::paper_begin);
    add(Pass::paper_springs);
    add(Pass::paper_gather);
    add(Pass::paper_count);
    if (cloth.method == Method::acad) {
        const auto levels = static_cast<std::uint32_t>(cloth.hierarchy.constraints.scan_levels());
        for (std::uint32_t level = 0; level < levels; ++level) add(Pass::paper_scan, Guard::idle, level);
        add(Pass::paper_list, Guard::idle);
    }
    add(Pass::paper_system, Guard::idle);
    add(Pass::paper_start, Guard::idle);
    for (std::uint32_t k = 0; k < cloth.paper.max_iterations; ++k) {
        add(Pass::paper_apply, Guard::linear);
        add(Pass::paper_alpha, Guard::linear);
        add(Pass::paper_update, Guard::linear);
        add(Pass::paper_check, Guard::linear);
        add(Pass::paper_direction, Guard::linear);
    }
    add(Pass::paper_multipliers, Guard::idle);
    add(Pass::paper_step);
    add(Pass::paper_end);
}

}  // namespace

std::uint32_t append_paper_frame(std::span<const ClothModel> cloths, std::uint32_t steps,
                                 std::uint32_t parity, std::vector<Call>& calls)
{
    for (std::uint32_t c = 0; c < cloths.size(); ++c) calls.push_back({Pass::solve_reset, c, parity, 0});
    for (std::uint32_t step = 0; step < steps; ++step, parity ^= 1)
        for (std::uint32_t c = 0; c < cloths.size(); ++c) {
            append_wind(cloths[c], c, step, parity, calls);
            append_attachments(cloths[c], c, step, parity, calls);
            append_step(cloths[c], c, step, parity, calls);
        }
    append_measures(cloths, parity, steps - 1, calls);
    return parity;
}

}  // namespace pliant
