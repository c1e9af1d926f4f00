// Constraints as one minimisation in each implicit step: Newton's method, each linear system by conjugate
// gradients with a multigrid V-cycle for its preconditioner. As sequences of passes; it knows no backend.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/cloth_model.hpp"
#include "solve/pass.hpp"

namespace pliant {

/// Appends one frame: `steps` implicit steps of every cloth, starting from the state copy `parity`, then the
/// measures of the state that they reach. Returns the parity of that state.
std::uint32_t append_constraint_frame(std::span<const ClothModel> cloths, std::uint32_t steps,
                                      std::uint32_t parity, std::vector<Call>& calls);

/// The same for ACAD: steps of springs alone, made good where they stretch a spring beyond the threshold.
std::uint32_t append_acad_frame(std::span<const ClothModel> cloths, std::uint32_t steps, std::uint32_t parity,
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
