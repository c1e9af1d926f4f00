#include "simulation/solver_memory.hpp"

#include <algorithm>
#include <span>

#include "kernels/planes.hpp"

namespace pliant {

std::vector<ArenaRange> solver_memory_ranges(const ClothModel& model)
{
    const Hierarchy& hierarchy = model.hierarchy;
    // ACAD's correcting step keeps none of these.
    if (hierarchy.empty() || model.plan.solver == Solver::paper || model.plan.corrects_steps()) return {};
    const SolverLevel& cloth = hierarchy.levels.front();
    const auto size = static_cast<std::size_t>(cloth.size);
    const auto planes = [&](int first, int count) {
        return ArenaRange{static_cast<std::size_t>(cloth.base + cloth.first_of_plane()) +
                              static_cast<std::size_t>(first) * size,
                          static_cast<std::size_t>(count) * size};
    };
    std::vector<ArenaRange> kept = {planes(plane_touched, plane_firm + 1 - plane_touched)};
    if (model.plan.is_second_order()) kept.push_back(planes(hierarchy.history_plane, history_planes));
    if (model.plan.on_grid)
        kept.push_back(planes(plane_slip, 8));
    else
        kept.push_back({static_cast<std::size_t>(cloth.edge_base) +
                            static_cast<std::size_t>(edge_slip) * static_cast<std::size_t>(cloth.edge_size),
                        2 * static_cast<std::size_t>(cloth.edge_size)});
    return kept;
}

std::vector<float> solver_memory(PassRunner& runner, const ClothModel& model, std::uint32_t index)
{
    std::vector<float> memory, part;
    for (const ArenaRange& kept : solver_memory_ranges(model)) {
        runner.solver_numbers(index, kept.first, kept.count, part);
        memory.insert(memory.end(), part.begin(), part.end());
    }
    return memory;
}

std::size_t solver_memory_size(const ClothModel& model)
{
    std::size_t size = 0;
    for (const ArenaRange& kept : solver_memory_ranges(model)) size += kept.count;
    return size;
}

void put_solver_memory(PassRunner& runner, const ClothModel& model, std::uint32_t index,
                       const std::vector<float>& memory)
{
    const std::vector<float> nothing(memory.empty() ? solver_memory_size(model) : 0);
    std::span<const float> left = memory.empty() ? nothing : memory;
    for (const ArenaRange& kept : solver_memory_ranges(model)) {
        runner.write_solver_numbers(index, kept.first, left.first(kept.count));
        left = left.subspan(kept.count);
    }
}

void fit_solver_memory(PassRunner& runner, const ClothModel& model, std::uint32_t index, double from,
                       double to)
{
    if (!(from > to) || !model.limits.remembers_any())
        return;  // a limit that is stiffer than need be is as good
    const SolverLevel& cloth = model.hierarchy.levels.front();
    const ArenaRange limits = solver_memory_ranges(model).back();  // slips, followed by as many stiffnesses
    std::vector<float> numbers;
    runner.solver_numbers(index, limits.first, limits.count, numbers);
    const std::span slips = std::span(numbers).first(limits.count / 2);
    const std::span stiffnesses = std::span(numbers).last(limits.count / 2);
    const auto class_of = [&](std::size_t k) {
        if (model.plan.on_grid)
            return k / static_cast<std::size_t>(cloth.size) % 2 == 0 ? SpringClass::structural
                                                                     : SpringClass::shear;
        return static_cast<SpringClass>(
            model.hierarchy.topology[static_cast<std::size_t>(cloth.edge_ends) + 3 * k + 2]);
    };
    struct Softest {
        double from = 0, to = 0;  // N/m
    } softest[spring_class_count];
    for (std::size_t c = 0; c < spring_class_count; ++c) {
        const auto of = static_cast<SpringClass>(c);
        if (model.limits.remembers(of))
            softest[c] = {model.limits.softest(of, from), model.limits.softest(of, to)};
    }
    for (std::size_t k = 0; k < slips.size(); ++k) {
        const double stiffness{stiffnesses[k]};
        if (!(stiffness > 0)) continue;  // new, or no limit
        Softest least = softest[static_cast<std::size_t>(class_of(k))];
        const auto edge = static_cast<std::int32_t>(k);
        if (!model.plan.on_grid && edge >= cloth.held && edge < cloth.loose) {
            least = {model.limits.softest_held(from), model.limits.softest_held(to)};
        }
        slips[k] =
            static_cast<float>(slips[k] * std::max(stiffness, least.from) / std::max(stiffness, least.to));
    }
    runner.write_solver_numbers(index, limits.first, slips);
}

}  // namespace pliant
