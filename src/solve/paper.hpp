// Constraints as the cloth paper enforces them: one linear system for the multipliers of a step, by conjugate
// gradients, and ACAD on top of it. As sequences of passes; it knows no backend.
#pragma once

#include <cstdint>
#include <vector>

#include "body/cloth_model.hpp"
#include "solve/pass.hpp"

namespace pliant {

/// Appends one step of one cloth by the solver paper, from the state copy `parity` to the other.
void append_paper_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step, std::uint32_t parity,
                       std::vector<Call>& calls);

}  // namespace pliant
