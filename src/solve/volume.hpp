// Soft bodies: springs, and one constraint for the volume of each, as sequences of passes; it knows no
// backend.
#pragma once

#include <cstdint>
#include <vector>

#include "body/cloth_model.hpp"
#include "solve/pass.hpp"

namespace pliant {

/// Appends one symplectic Euler step of the bodies of a model with their volume constraint, from the state
/// copy `parity` to the other.
void append_volume_step(const ClothModel& bodies, std::uint32_t index, std::uint32_t step,
                        std::uint32_t parity, std::vector<Call>& calls);

/// Appends the measure of the volumes of model `index` in the state copy `parity`.
void append_volumes(std::uint32_t index, std::uint32_t parity, std::vector<Call>& calls);

}  // namespace pliant
