#include "simulation/solver_memory.hpp"

#include "kernels/planes.hpp"

namespace pliant {
namespace {

/// Numbers of the arena (Hierarchy).
struct ArenaRange {
    std::size_t first = 0, count = 0;
};

std::vector<ArenaRange> kept_numbers(const ClothModel& model)
{
    const Hierarchy& hierarchy = model.hierarchy;
    // A step of ACAD that makes springs good remembers nothing of these.
    if (hierarchy.empty() || model.solver == Solver::paper || model.corrects_steps()) return {};
    const SolverLevel& cloth = hierarchy.levels.front();
    const auto size = static_cast<std::size_t>(cloth.size);
    const auto planes = [&](int first, int count) {
        return ArenaRange{static_cast<std::size_t>(cloth.base) + static_cast<std::size_t>(first) * size,
                          static_cast<std::size_t>(count) * size};
    };
    std::vector<ArenaRange> kept = {planes(plane_touched, plane_firm + 1 - plane_touched)};
    if (model.is_sheet())
        kept.push_back(planes(plane_slip, 8));
    else
        kept.push_back({static_cast<std::size_t>(cloth.edge_base) +
                            static_cast<std::size_t>(edge_slip) * static_cast<std::size_t>(cloth.edge_size),
                        2 * static_cast<std::size_t>(cloth.edge_size)});
    return kept;
}

}  // namespace

std::vector<float> solver_memory(PassRunner& runner, const ClothModel& model, std::uint32_t index)
{
    std::vector<float> memory, part;
    for (const ArenaRange& kept : kept_numbers(model)) {
        runner.solver_numbers(index, kept.first, kept.count, part);
        memory.insert(memory.end(), part.begin(), part.end());
    }
    return memory;
}

std::size_t solver_memory_size(const ClothModel& model)
{
    std::size_t size = 0;
    for (const ArenaRange& kept : kept_numbers(model)) size += kept.count;
    return size;
}

void put_solver_memory(PassRunner& runner, const ClothModel& model, std::uint32_t index,
                       const std::vector<float>& memory)
{
    const std::vector<float> nothing(memory.empty() ? solver_memory_size(model) : 0);
    std::span<const float> left = memory.empty() ? nothing : memory;
    for (const ArenaRange& kept : kept_numbers(model)) {
        runner.write_solver_numbers(index, kept.first, left.first(kept.count));
        left = left.subspan(kept.count);
    }
}

}  // namespace pliant
