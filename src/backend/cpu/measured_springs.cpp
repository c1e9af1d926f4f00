#include "backend/cpu/measured_springs.hpp"

#include "backend/cpu/slices.hpp"

namespace pliant::cpu {

MeasuredSprings::MeasuredSprings(const PlainCloth<float>& cloth)
{
    const ClothModel& model = cloth.model;
    if (model.plan.on_grid) return;
    start_.push_back(0);
    std::vector<Neighbour> rows[Slices::lanes];
    for (std::size_t first = 0; first < model.node_count(); first += Slices::lanes) {
        for (std::size_t lane = 0; lane < Slices::lanes; ++lane) {
            const std::size_t node = first + lane;
            rows[lane].clear();
            if (node >= model.node_count()) continue;
            for (const Neighbour& neighbour : model.springs.neighbours.row(node))
                if (neighbour.node > node) rows[lane].push_back(neighbour);
        }
        append_slice(
            start_, [&](std::size_t lane) { return rows[lane].size(); },
            [&](std::size_t lane, std::size_t k, bool exists) {
                const std::size_t node = exists ? rows[lane][k].node : first;
                const Spring& spring = model.springs.list[exists ? rows[lane][k].spring : 0];
                const auto of = static_cast<std::size_t>(spring.spring_class);
                place_.push_back(static_cast<std::uint32_t>(cloth.layout.offset(node) * state_size));
                rest_length_.push_back(exists ? static_cast<float>(spring.rest_length) : -1.0f);
                stiffness_.push_back(static_cast<float>(model.parameters.stiffness[of]) *
                                     static_cast<float>(spring.scale));
                bending_.push_back(static_cast<float>(spring.bending));
                counts_.push_back(spring.spring_class == SpringClass::bend ? 0.0f : 1.0f);
            });
    }
}

}  // namespace pliant::cpu
