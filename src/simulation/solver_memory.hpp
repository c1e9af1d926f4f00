// What the constraint solver keeps of a cloth from step to step: forces of contact and of limits with memory.
// It is part of the state of a simulation.
#pragma once

#include <vector>

#include "backend/pass_runner.hpp"
#include "body/cloth_model.hpp"

namespace pliant {

/// Ranges of the arena; empty for a cloth without such a solver.
std::vector<ArenaRange> solver_memory_ranges(const ClothModel& model);

std::vector<float> solver_memory(PassRunner& runner, const ClothModel& model, std::uint32_t index);

/// The count of its numbers.
std::size_t solver_memory_size(const ClothModel& model);

/// Restores the memory. If it is empty, the solver starts without memory.
void put_solver_memory(PassRunner& runner, const ClothModel& model, std::uint32_t index,
                       const std::vector<float>& memory);

/// Rescales the limits' memory from steps of length `from` (s) to steps of length `to`: stiffnesses depend on
/// the length, forces do not change.
void fit_solver_memory(PassRunner& runner, const ClothModel& model, std::uint32_t index, double from,
                       double to);

}  // namespace pliant
