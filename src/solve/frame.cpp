#include "solve/frame.hpp"

#include <array>

#include "solve/mass_spring.hpp"
#include "solve/newton_multigrid.hpp"
#include "solve/paper.hpp"
#include "solve/volume.hpp"

namespace pliant {

namespace {

void append_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step, std::uint32_t parity,
                 std::vector<Call>& calls)
{
    using Step = SteppingPlan::Step;
    switch (cloth.plan.step) {
        case Step::springs:
        case Step::stages:
        case Step::body_springs:
        case Step::body_list: return append_mass_spring_step(cloth, index, step, parity, calls);
        case Step::body_volume: return append_volume_step(cloth, index, step, parity, calls);
        case Step::newton: return append_constraint_step(cloth, index, step, parity, calls);
        case Step::acad: return append_acad_step(cloth, index, step, parity, calls);
        case Step::paper: return append_paper_step(cloth, index, step, parity, calls);
    }
}

/// The loops of linear systems and of the line search are inside Newton's: when that has ended, so have they.
bool ends_with(Guard outer, Guard guard)
{
    return guard == outer || (outer == Guard::newton && (guard == Guard::linear || guard == Guard::search));
}

/// For each guarded call, counts the following calls that are skipped with it. Skipped calls do not change
/// their guards, so an ended loop is left in one jump.
void count_guarded(std::vector<Call>& calls)
{
    constexpr std::array guards = {Guard::newton, Guard::linear, Guard::search, Guard::idle};
    std::array<std::size_t, guards.size()> ends{};  // by guard: the next call that is not skipped
    for (std::size_t k = calls.size(); k-- > 0;) {
        Call& call = calls[k];
        if (k + 1 == calls.size() || calls[k + 1].cloth != call.cloth) ends.fill(k + 1);
        for (std::size_t g = 0; g < guards.size(); ++g) {
            if (!ends_with(guards[g], call.guard)) ends[g] = k;
            if (call.guard == guards[g]) call.guarded_after = static_cast<std::uint32_t>(ends[g] - k - 1);
        }
    }
}

}  // namespace

std::uint32_t append_frame(std::span<const ClothModel> cloths, std::uint32_t steps, std::uint32_t parity,
                           std::vector<Call>& calls, std::uint32_t grabbed, std::uint32_t only)
{
    const std::uint32_t first = only == no_cloth ? 0 : only;
    const std::uint32_t end = only == no_cloth ? static_cast<std::uint32_t>(cloths.size()) : only + 1;
    for (std::uint32_t c = first; c < end; ++c)
        if (cloths[c].plan.has_solver()) calls.push_back({Pass::solve_reset, c, parity, 0});
    for (std::uint32_t step = 0; step < steps; ++step, parity ^= 1)
        for (std::uint32_t c = first; c < end; ++c) {
            if (c == grabbed && !cloths[c].plan.is_implicit()) calls.push_back({Pass::grab, c, parity, step});
            append_step(cloths[c], c, step, parity, calls);
        }
    for (std::uint32_t c = first; c < end; ++c) append_measures(cloths[c], c, parity, steps - 1, calls);
    count_guarded(calls);
    return parity;
}

}  // namespace pliant
