// Constraints as the cloth paper enforces them: one linear system for the multipliers of a step, by conjugate
// gradients, and ACAD on top of it. As sequences of passes; it knows no backend.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/cloth_model.hpp"
#include "solve/pass.hpp"

namespace pliant {

/// Appends one frame of the solver paper: `steps` steps of every cloth, starting from the state copy
/// `parity`, then the measures of the state that they reach. Returns the parity of that state.
std::uint32_t append_paper_frame(std::span<const ClothModel> cloths, std::uint32_t steps,
                                 std::uint32_t parity, std::vector<Call>& calls);

}  // namespace pliant
