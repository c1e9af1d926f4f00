#include "solve/mass_spring.hpp"

#include "solve/chosen_passes.hpp"
#include "solve/volume.hpp"

namespace pliant {
namespace {

/// Explicit Euler and Runge-Kutta: the forces of the stage's initial state, then the stage. From the second
/// stage on that state is in the next copy, so forces use the other parity.
void append_stages(const ClothModel& cloth, std::uint32_t index, std::uint32_t step, std::uint32_t parity,
                   std::vector<Call>& calls)
{
    const bool euler = cloth.plan.integrator == Integrator::explicit_euler;
    for (std::uint32_t stage = euler ? 0 : 1; stage <= (euler ? 0u : 4u); ++stage) {
        const std::uint32_t state = stage <= 1 ? parity : parity ^ 1;
        append_external_forces(cloth, index, step, state, calls);
        calls.push_back({Pass::spring_force, index, state, step});
        calls.push_back({Pass::stage_step, index, parity, step, 0, stage});
    }
    append_attachments(cloth, index, step, parity, calls);
}

}  // namespace

void append_mass_spring_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step,
                             std::uint32_t parity, std::vector<Call>& calls)
{
    if (cloth.plan.step == SteppingPlan::Step::stages)
        return append_stages(cloth, index, step, parity, calls);
    const Pass pass = passes_of(cloth.plan).step;
    append_external_forces(cloth, index, step, parity, calls);
    if (pass == Pass::list_step) calls.push_back({Pass::spring_force, index, parity, step});
    calls.push_back({pass, index, parity, step});
    append_attachments(cloth, index, step, parity, calls);
}

void append_attachments(const ClothModel& cloth, std::uint32_t index, std::uint32_t step,
                        std::uint32_t parity, std::vector<Call>& calls)
{
    if (!cloth.attachments.empty()) calls.push_back({Pass::attach, index, parity, step});
}

void append_external_forces(const ClothModel& cloth, std::uint32_t index, std::uint32_t step,
                            std::uint32_t parity, std::vector<Call>& calls)
{
    if (cloth.feels_air()) calls.push_back({passes_of(cloth.plan).wind, index, parity, step});
    if (cloth.body && !cloth.body->loads.empty()) calls.push_back({Pass::load_force, index, parity, step});
}

void append_measures(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity, std::uint32_t step,
                     std::vector<Call>& calls)
{
    calls.push_back({passes_of(cloth.plan).measure, index, parity, step});
    const std::size_t levels = MeasureTree(cloth.node_count()).levels.size();
    for (std::uint32_t level = 1; level < levels; ++level)
        calls.push_back({Pass::measure_merge, index, parity, level});
    if (cloth.body) append_volumes(index, parity, calls);
}

void append_drawing(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity,
                    std::vector<Call>& calls)
{
    calls.push_back({passes_of(cloth.plan).normal, index, parity, 0});
    calls.push_back({passes_of(cloth.plan).strain, index, parity, 0});
}

}  // namespace pliant
