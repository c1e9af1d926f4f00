// Constraints as one minimisation in each implicit step: Newton's method, each linear system by conjugate
// gradients with a multigrid V-cycle for its preconditioner. As sequences of passes; it knows no backend.
#pragma once

#include <cstdint>
#include <vector>

#include "body/cloth_model.hpp"
#include "solve/pass.hpp"

namespace pliant {

/// Newton iterations of a step, unless it is not solved by then.
std::uint32_t enough_iterations(const ClothModel& cloth);

/// Appends one implicit step of one cloth, from the state copy `parity` to the other.
void append_constraint_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step,
                            std::uint32_t parity, std::vector<Call>& calls);

/// The same for ACAD: a step of springs alone, made good where it stretches a spring beyond the threshold.
void append_acad_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step, std::uint32_t parity,
                      std::vector<Call>& calls);

/// The first linear system of a step by itself, for measurements: what assembles it at the state copy
/// `parity`, what prepares conjugate gradients for it (with the hierarchy, where there is one), and
/// iterations.
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
