// Reads states from a simulation and puts states into it.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "simulation/implementation.hpp"
#include "simulation/solver_memory.hpp"
#include "simulation/start_warnings.hpp"
#include "solve/mass_spring.hpp"
#include "solve/newton_multigrid.hpp"

namespace pliant {

State Simulation::Implementation::state()
{
    State now{report.simulated_seconds, {}, {}, memory_step, lets_rise};
    for (std::size_t c = 0; c < places.size(); ++c) {
        const auto x = values(c, Resource::position), v = values(c, Resource::velocity);
        now.cloths.push_back({{x.begin(), x.end()}, {v.begin(), v.end()}});
    }
    for (std::uint32_t m = 0; m < models.size(); ++m)
        now.memory.push_back(solver_memory(*runner, models[m], m));
    return now;
}

void Simulation::Implementation::set_state(const State& state)
{
    bool fits = state.cloths.size() == places.size();
    for (std::size_t c = 0; fits && c < places.size(); ++c)
        fits = state.cloths[c].positions.size() == places[c].node_count &&
               state.cloths[c].velocities.size() == places[c].node_count;
    if (!fits)
        throw Error(ErrorKind::bad_usage,
                    "Simulation::set_state: the state has other cloths, or other numbers of nodes, than "
                    "the scene");
    release();
    const bool knows_who_rises = state.lets_rise.size() == scene.colliders.size();
    lets_rise = knows_who_rises ? state.lets_rise : std::vector<std::uint8_t>(scene.colliders.size());
    for (std::uint32_t m = 0; m < models.size(); ++m) {
        std::vector<Vec3> x(models[m].node_count()), v(models[m].node_count());
        for (std::size_t c = 0; c < places.size(); ++c) {
            if (places[c].model != m) continue;
            const Vec3d origin = models[m].shape.origin;
            for (std::size_t i = 0; i < places[c].node_count; ++i) {
                const Vec3 at = state.cloths[c].positions[i];
                x[places[c].node(i)] = origin == Vec3d{} ? at : to_float(to_double(at) - origin);
                v[places[c].node(i)] = state.cloths[c].velocities[i];
            }
        }
        std::vector<bool> moved(x.size(), false);
        for (const AttachedNode& a : models[m].attachments.nodes) moved[a.node] = true;
        for (std::size_t i = 0; i < x.size(); ++i)
            if (!(models[m].masses.inverse(i) > 0) && !moved[i]) v[i] = {};  // a pin that does not move
        runner->write(m, x, v);
        if (!knows_who_rises) find_sunk(scene, models[m], x, state.time, lets_rise);
        // The memory of another method or solver does not apply here.
        const bool knows = m < state.memory.size() && state.memory[m].size() == solver_memory_size(models[m]);
        put_solver_memory(*runner, models[m], m, knows ? state.memory[m] : std::vector<float>{});
    }
    memory_step = state.step;
    report.simulated_seconds = state.time;
    report.finite = true;
    idle_seconds = owed_seconds = 0;
    ++state_number;
    measure();
    take_measures();
}

std::span<const Vec3> Simulation::Implementation::values(std::size_t cloth, Resource resource)
{
    ReadBack& read_back = read_backs.at(cloth);
    ReadBack::Values<Vec3>& target = resource == Resource::position   ? read_back.positions
                                     : resource == Resource::velocity ? read_back.velocities
                                                                      : read_back.normals;
    if (target.frame == state_number) return target.values;
    if (resource == Resource::normal) update_drawing(cloth);
    const ClothPlace& place = places[cloth];
    const std::vector<float>& all = read_model(place.model, resource);
    const Vec3d origin = resource == Resource::position ? models[place.model].shape.origin : Vec3d{};
    target.values.resize(place.node_count);
    target.frame = state_number;
    if (place.node_of_vertex.empty() && origin == Vec3d{}) {
        static_assert(sizeof(Vec3) == 3 * sizeof(float));
        std::memcpy(static_cast<void*>(target.values.data()), &all[3 * std::size_t{place.first_node}],
                    target.values.size() * sizeof(Vec3));
        return target.values;
    }
    for (std::size_t i = 0; i < target.values.size(); ++i) {
        const std::size_t at = 3 * place.node(i);
        const Vec3 a{all[at], all[at + 1], all[at + 2]};
        target.values[i] = origin == Vec3d{} ? a : to_float(to_double(a) + origin);
    }
    return target.values;
}

const std::vector<float>& Simulation::Implementation::read_model(std::uint32_t model, Resource resource)
{
    ReadBack::Values<float>& target = read_models[model][resource];
    if (target.frame != state_number) runner->read(model, resource, parity, target.values);
    target.frame = state_number;
    return target.values;
}

void Simulation::Implementation::read_cloth(std::size_t cloth, Resource resource, std::vector<float>& into)
{
    const ClothPlace& place = places[cloth];
    const std::vector<float>& all = read_model(place.model, resource);
    into.resize(place.node_count);
    for (std::size_t i = 0; i < into.size(); ++i) into[i] = all[place.node(i)];
}

std::span<const float> Simulation::Implementation::strains(std::size_t cloth)
{
    ReadBack::Values<float>& target = read_backs.at(cloth).strains;
    if (target.frame == state_number) return target.values;
    update_drawing(cloth);
    read_cloth(cloth, Resource::strain, target.values);
    target.frame = state_number;
    return target.values;
}

std::span<const float> Simulation::Implementation::multipliers(std::size_t cloth)
{
    ReadBack::Values<float>& target = read_backs.at(cloth).multipliers;
    if (target.frame == state_number) return target.values;
    const std::uint32_t model = places[cloth].model;
    if (!uses_solver(stepped_method(scene))) {
        target.values.assign(places[cloth].node_count, 0.0f);
    } else {
        Program& program = multiplier_programs[{model, parity}];
        if (program.calls.empty()) {
            program = {next_program_id++, {}, parity};
            append_multipliers(models[model], model, parity, program.calls);
        }
        runner->run(program, input(1 / scene.time.frame_rate));
        read_cloth(cloth, Resource::multiplier, target.values);
    }
    target.frame = state_number;
    return target.values;
}

std::vector<SpringListing> Simulation::Implementation::springs(std::size_t cloth) const
{
    const auto& place = places.at(cloth);
    const ClothModel& model = models[place.model];
    std::vector<SpringListing> listing;
    const auto add = [&](std::uint32_t i, std::uint32_t j, SpringClass of, double rest_length) {
        auto kind = static_cast<SpringKind>(of);
        if (model.plan.is_body() && of == SpringClass::shear) kind = SpringKind::internal;
        listing.push_back({i, j, kind, rest_length});
    };
    if (model.springs.list.empty() && model.shape.sheet) {
        for_each_sheet_spring(
            *model.shape.sheet, [&](std::uint32_t i, std::uint32_t j, const SheetNeighbour& n) {
                add(i, j, n.spring_class, model.shape.sheet->rest_lengths[static_cast<std::size_t>(n.rest)]);
            });
        return listing;
    }
    std::vector<std::uint32_t> vertex_of(place.node_count);
    for (std::uint32_t k = 0; k < place.node_count; ++k) vertex_of[place.node(k) - place.first_node] = k;
    for (const Spring& spring : model.springs.list) {
        if (spring.i < place.first_node || spring.i >= place.first_node + place.node_count) continue;
        const auto [i, j] =
            std::minmax(vertex_of[spring.i - place.first_node], vertex_of[spring.j - place.first_node]);
        add(i, j, spring.spring_class, spring.rest_length);
    }
    std::sort(listing.begin(), listing.end(), by_ends);
    return listing;
}

std::span<const std::uint32_t> Simulation::Implementation::held_springs(std::size_t cloth)
{
    ReadBack::Values<std::uint32_t>& target = read_backs.at(cloth).held;
    if (target.frame == state_number) return target.values;
    const ClothPlace& place = places[cloth];
    if (models[place.model].plan.is_body()) return {};  // bodies have no constraints
    held.resize(places.size());
    if (!held[cloth]) held[cloth].emplace(models[place.model], springs(cloth), place.node_of_vertex);
    const auto forces = multipliers(cloth);
    held[cloth]->read(*runner, place.model, values(cloth, Resource::position), forces, target.values);
    target.frame = state_number;
    return target.values;
}

void Simulation::Implementation::update_drawing(std::size_t cloth)
{
    const std::uint32_t model = places[cloth].model;
    if (drawn.size() < models.size()) drawn.resize(models.size(), 0);
    if (drawn[model] == state_number) return;
    drawn[model] = state_number;
    if (device_state) {
        device_state->drawable(model);
        return;
    }
    Program& program = drawing_programs[{model, parity}];
    if (program.calls.empty()) {
        program = {next_program_id++, {}, parity};
        append_drawing(models[model], model, parity, program.calls);
    }
    runner->run(program, input(0));
}

}  // namespace pliant
