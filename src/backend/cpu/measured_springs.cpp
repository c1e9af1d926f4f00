#include "backend/cpu/measured_springs.hpp"

#include <algorithm>

namespace pliant::cpu {

MeasuredSprings::MeasuredSprings(const PlainCloth<float>& cloth)
{
    const ClothModel& model = cloth.model;
    if (model.is_sheet()) return;
    start_.push_back(0);
    std::vector<Neighbour> rows[Slices::lanes];
    for (std::size_t first = 0; first < model.node_count(); first += Slices::lanes) {
        std::size_t longest = 0;
        for (std::size_t lane = 0; lane < Slices::lanes; ++lane) {
            const std::size_t node = first + lane;
            rows[lane].clear();
            if (node >= model.node_count()) continue;
            for (const Neighbour& neighbour : model.neighbours.row(node))
                if (neighbour.node > node) rows[lane].push_back(neighbour);
            longest = std::max(longest, rows[lane].size());
        }
        for (std::size_t r = 0; r < longest; ++r)
            for (std::size_t lane = 0; lane < Slices::lanes; ++lane) {
                const bool exists = r < rows[lane].size();
                const std::size_t node = exists ? rows[lane][r].node : first;
                const Spring& spring = model.springs[exists ? rows[lane][r].spring : 0];
                const auto k = static_cast<std::size_t>(spring.spring_class);
                place_.push_back(static_cast<std::uint32_t>(cloth.layout.offset(node) * state_size));
                rest_length_.push_back(exists ? static_cast<float>(spring.rest_length) : -1.0f);
                stiffness_.push_back(static_cast<float>(model.parameters.stiffness[k]) *
                                     static_cast<float>(spring.scale));
                bending_.push_back(static_cast<float>(spring.bending));
                counts_.push_back(spring.spring_class == SpringClass::bend ? 0.0f : 1.0f);
            }
        start_.push_back(static_cast<std::uint32_t>(place_.size() / Slices::lanes));
    }
}

}  // namespace pliant::cpu
