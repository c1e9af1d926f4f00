#include "solve/mass_spring.hpp"

#include "solve/volume.hpp"

namespace pliant {

void append_mass_spring_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step,
                             std::uint32_t parity, std::vector<Call>& calls)
{
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

void append_measures(std::span<const ClothModel> cloths, std::uint32_t parity, std::uint32_t step,
                     std::vector<Call>& calls)
{
    for (std::uint32_t c = 0; c < cloths.size(); ++c) {
        calls.push_back(
            {cloths[c].node_centric() ? Pass::sheet_measure : Pass::list_measure, c, parity, step});
        const std::size_t levels = MeasureTree(cloths[c].node_count()).levels.size();
        for (std::uint32_t level = 1; level < levels; ++level)
            calls.push_back({Pass::measure_merge, c, parity, level});
        if (cloths[c].is_body()) append_volumes(c, parity, calls);
    }
}

void append_drawing(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity,
                    std::vector<Call>& calls)
{
    calls.push_back({cloth.is_sheet() ? Pass::sheet_normal : Pass::mesh_normal, index, parity, 0});
    calls.push_back({cloth.node_centric() ? Pass::sheet_strain : Pass::list_strain, index, parity, 0});
}

}  // namespace pliant
