// What the constraint solver keeps of a cloth from step to step: forces of contact, and of limits that
// remember them. It belongs to the state of a simulation.
#pragma once

#include <vector>

#include "backend/pass_runner.hpp"
#include "body/cloth_model.hpp"

namespace pliant {

/// Where it lies; none for a cloth that has no such solver.
std::vector<ArenaRange> solver_memory_ranges(const ClothModel& model);

std::vector<float> solver_memory(PassRunner& runner, const ClothModel& model, std::uint32_t index);

/// How many numbers it has.
std::size_t solver_memory_size(const ClothModel& model);

/// Takes them back; empty, and the solver begins anew.
void put_solver_memory(PassRunner& runner, const ClothModel& model, std::uint32_t index,
                       const std::vector<float>& memory);

/// Makes what limits remember of steps of the length `from` (s) fit steps of the length `to`: their stiffness
/// goes by the length, and their forces stay.
void fit_solver_memory(PassRunner& runner, const ClothModel& model, std::uint32_t index, double from,
                       double to);

}  // namespace pliant
