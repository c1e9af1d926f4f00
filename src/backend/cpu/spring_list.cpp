#include "backend/cpu/spring_list.hpp"

#include <algorithm>
#include <utility>

#include "backend/cpu/pointers.hpp"
#include "backend/cpu/slices.hpp"

namespace pliant::cpu {

SpringList::SpringList(PlainCloth<float>& cloth)
{
    const ClothModel& model = cloth.model;
    const NodeLayout& layout = cloth.layout;
    if (!model.plan.lists_springs()) return;
    const auto place_of = [&](std::size_t node) {
        return static_cast<std::uint32_t>(layout.offset(node) * state_size);
    };
    bool bends = false;
    for (const Spring& spring : model.springs.list) {
        const auto k = static_cast<std::size_t>(spring.spring_class);
        first_.push_back(place_of(spring.i));
        second_.push_back(place_of(spring.j));
        rest_length_.push_back(static_cast<float>(spring.rest_length));
        const auto scale = static_cast<float>(spring.scale);
        stiffness_.push_back(static_cast<float>(model.parameters.stiffness[k]) * scale);
        damping_.push_back(static_cast<float>(model.parameters.spring_damping[k]) * scale);
        bending_.push_back(static_cast<float>(spring.bending));
        bends = bends || spring.bending != 0;
    }
    const std::size_t size = (first_.size() + pack - 1) / pack * pack;
    const std::uint32_t somewhere = place_of(0);
    first_.resize(size, somewhere);
    second_.resize(size, somewhere);
    for (auto* numbers : {&rest_length_, &stiffness_, &damping_, &bending_}) numbers->resize(size, 0.0f);
    if (!bends) std::vector<float>().swap(bending_);
    cloth.spring_force = VectorArray<float>(size + 1);  // the last one stays 0: for lanes with fewer springs

    start_.push_back(0);
    for (std::size_t row = 0; row < layout.rows; ++row)
        for (std::size_t column = 0; column < layout.columns; column += Slices::lanes) {
            const std::size_t count = std::min(Slices::lanes, layout.columns - column);
            const std::size_t node = row * layout.columns + column;
            const auto row_of = [&](std::size_t lane) {
                return lane < count ? model.springs.neighbours.row(node + lane)
                                    : std::span<const Neighbour>();
            };
            append_slice(
                start_, [&](std::size_t lane) { return row_of(lane).size(); },
                [&](std::size_t lane, std::size_t k, bool exists) {
                    std::size_t entry = vector_size * size;
                    if (exists) {
                        const Neighbour& neighbour = row_of(lane)[k];
                        entry = vector_size * std::size_t{neighbour.spring} +
                                (neighbour.node < node + lane ? 1 : 0);
                    }
                    springs_.push_back(static_cast<std::uint32_t>(entry));
                });
            runs_.push_back(
                {static_cast<std::uint32_t>(layout.offset(row, column)), static_cast<std::uint32_t>(count)});
        }
}

void SpringList::find_forces(const Call& call, PlainCloth<float>& cloth, const StateRecords& records,
                             const Kernels& kernels, std::size_t begin, std::size_t end) const
{
    kernels.spring_forces({records.at(call.parity), cloth.spring_force.data(), first_.data(), second_.data(),
                           rest_length_.data(), stiffness_.data(), damping_.data(),
                           bending_.empty() ? nullptr : bending_.data()},
                          begin, end);
}

void SpringList::step(const Call& call, PlainCloth<float>& cloth, StateRecords& records,
                      const Kernels& kernels, const StepConstants<float>& constants,
                      std::span<const Laws<float>::Collider> colliders, std::size_t begin,
                      std::size_t end) const
{
    const std::uint32_t next = 1 - call.parity;
    ListArguments a{};
    a.runs = runs_.data();
    a.start = start_.data();
    a.springs = springs_.data();
    a.force = cloth.spring_force.data();
    a.position = pointers(std::as_const(cloth.position[call.parity]));
    a.velocity = pointers(std::as_const(cloth.velocity[call.parity]));
    a.next_position = pointers(cloth.position[next]);
    a.next_velocity = pointers(cloth.velocity[next]);
    a.next_state = records.at(next);
    if (cloth.model.has_external_force()) a.external_force = pointers(std::as_const(cloth.external_force));
    a.inverse_mass = cloth.inverse_mass.data();
    a.constants = &constants;
    a.colliders = colliders.data();
    a.collider_count = colliders.size();
    kernels.list_step(a, begin, end);
}

}  // namespace pliant::cpu
