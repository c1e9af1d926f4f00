#include "solve/mass_spring.hpp"

#include "solve/volume.hpp"

namespace pliant {
namespace {

/// Explicit Euler and Runge-Kutta: the forces of the stage's initial state, then the stage. From the second
/// stage on that state is in the next copy, so forces use the other parity.
void append_stages(const ClothModel& cloth, std::uint32_t index, std::uint32_t step, std::uint32_t parity,
                   std::vector<Call>& calls)
{
    const bool euler = cloth.integrator == Integrator::explicit_euler;
    for (std::uint32_t stage = euler ? 0 : 1; stage <= (euler ? 0u : 4u); ++stage) {
        const std::uint32_t state = stage <= 1 ? parity : parity ^ 1;
        append_wind(cloth, index, step, state, calls);
        calls.push_back({Pass::spring_force, index, state, step});
        calls.push_back({Pass::stage_step, index, parity, step, 0, stage});
    }
    append_attachments(cloth, index, step, parity, calls);
}

}  // namespace

void append_mass_spring_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step,
                             std::uint32_t parity, std::vector<Call>& calls)
{
    if (cloth.integrator == Integrator::explicit_euler || cloth.integrator == Integrator::runge_kutta_4)
        return append_stages(cloth, index, step, parity, calls);
    append_wind(cloth, index, step, parity, calls);
    if (!cloth.node_centric()) calls.push_back({Pass::spring_force, index, parity, step});
    calls.push_back({cloth.node_centric() ? Pass::sheet_step : Pass::list_step, index, parity, step});
    append_attachments(cloth, index, step, parity, calls);
}

void append_attachments(const ClothModel& cloth, std::uint32_t index, std::uint32_t step,
                        std::uint32_t parity, std::vector<Call>& calls)
{
    if (!cloth.attached.empty()) calls.push_back({Pass::attach, index, parity, step});
}

void append_wind(const ClothModel& cloth, std::uint32_t index, std::uint32_t step, std::uint32_t parity,
                 std::vector<Call>& calls)
{
    if (cloth.feels_air())
        calls.push_back({cloth.is_sheet() ? Pass::sheet_wind : Pass::mesh_wind, index, parity, step});
}

void append_measures(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity, std::uint32_t step,
                     std::vector<Call>& calls)
{
    calls.push_back({cloth.node_centric() ? Pass::sheet_measure : Pass::list_measure, index, parity, step});
    const std::size_t levels = MeasureTree(cloth.node_count()).levels.size();
    for (std::uint32_t level = 1; level < levels; ++level)
        calls.push_back({Pass::measure_merge, index, parity, level});
    if (cloth.is_body()) append_volumes(index, parity, calls);
}

void append_drawing(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity,
                    std::vector<Call>& calls)
{
    calls.push_back({cloth.is_sheet() ? Pass::sheet_normal : Pass::mesh_normal, index, parity, 0});
    calls.push_back({cloth.node_centric() ? Pass::sheet_strain : Pass::list_strain, index, parity, 0});
}

}  // namespace pliant
