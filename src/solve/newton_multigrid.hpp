// Constraints as one minimisation per implicit step: Newton's method, with each linear system solved by
// conjugate gradients and a multigrid V-cycle as preconditioner. Sequences of passes, independent of the
// backend.
#pragma once

#include <cstdint>
#include <vector>

#include "body/cloth_model.hpp"
#include "solve/pass.hpp"

namespace pliant {

/// Newton iterations of a step that is solved by then; others take more.
std::uint32_t enough_iterations(const ClothModel& cloth);

/// Appends one implicit step of one cloth, from the state copy `parity` to the other.
void append_constraint_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step,
                            std::uint32_t parity, std::vector<Call>& calls);

/// The same for ACAD: a step with springs alone, corrected if a spring exceeds the threshold.
void append_acad_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step, std::uint32_t parity,
                      std::vector<Call>& calls);

/// The first linear system of a step, for measurements. Three parts: assembly at the state copy `parity`;
/// preparation of conjugate gradients, with the hierarchy if there is one; iterations.
void append_linear_system(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity,
                          std::vector<Call>& calls);
void append_linear_start(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity,
                         std::vector<Call>& calls);
void append_linear_iterations(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity,
                              std::uint32_t count, std::vector<Call>& calls);

/// Appends the largest constraint force at each node, after the last step.
void append_multipliers(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity,
                        std::vector<Call>& calls);

}  // namespace pliant
