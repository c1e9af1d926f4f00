// Soft bodies: springs, and one volume constraint per body, as sequences of passes, independent of the
// backend.
#pragma once

#include <cstdint>
#include <vector>

#include "body/cloth_model.hpp"
#include "solve/pass.hpp"

namespace pliant {

/// Appends one symplectic Euler step of the bodies of a model, from the state copy `parity` to the other,
/// with the volume constraint if the model has one.
void append_volume_step(const ClothModel& bodies, std::uint32_t index, std::uint32_t step,
                        std::uint32_t parity, std::vector<Call>& calls);

/// Appends the measure of the volumes of model `index` in the state copy `parity`.
void append_volumes(std::uint32_t index, std::uint32_t parity, std::vector<Call>& calls);

}  // namespace pliant
