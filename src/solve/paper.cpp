#include "solve/paper.hpp"

#include "solve/mass_spring.hpp"

namespace pliant {

void append_paper_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step, std::uint32_t parity,
                       std::vector<Call>& calls)
{
    const auto add = [&](Pass pass, Guard guard = Guard::none, std::uint32_t detail = 0) {
        calls.push_back({pass, index, parity, step, 0, detail, guard});
    };
    append_external_forces(cloth, index, step, parity, calls);
    append_attachments(cloth, index, step, parity, calls);
    add(Pass::paper_begin);
    add(Pass::paper_springs);
    add(Pass::paper_gather);
    add(Pass::paper_count);
    if (cloth.plan.method == Method::acad) {
        const auto levels = static_cast<std::uint32_t>(cloth.hierarchy.constraints.scan_levels());
        for (std::uint32_t level = 0; level < levels; ++level) add(Pass::paper_scan, Guard::idle, level);
        add(Pass::paper_list, Guard::idle);
    }
    add(Pass::paper_system, Guard::idle);
    add(Pass::paper_start, Guard::idle);
    for (std::uint32_t k = 0; k < cloth.plan.paper.max_iterations; ++k) {
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

}  // namespace pliant
