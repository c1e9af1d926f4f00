// Constraints as the cloth paper enforces them: one linear system per step for the multipliers, solved by
// conjugate gradients; and ACAD on top of it. Sequences of passes, independent of the backend.
#pragma once

#include <cstdint>
#include <vector>

#include "body/cloth_model.hpp"
#include "solve/pass.hpp"

namespace pliant {

/// Appends one step of one cloth by the paper's solver, from the state copy `parity` to the other.
void append_paper_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step, std::uint32_t parity,
                       std::vector<Call>& calls);

}  // namespace pliant
