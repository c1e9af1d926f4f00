// The mass-spring method as sequences of passes, independent of the backend.
#pragma once

#include <cstdint>
#include <span>

#include "body/cloth_model.hpp"
#include "solve/pass.hpp"

namespace pliant {

/// Appends one explicit step of springs alone, of a cloth or of soft bodies, from the state copy `parity` to
/// the other.
void append_mass_spring_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step,
                             std::uint32_t parity, std::vector<Call>& calls);

/// Appends the motion of attached nodes to where their pins are at the end of a step.
void append_attachments(const ClothModel& cloth, std::uint32_t index, std::uint32_t step,
                        std::uint32_t parity, std::vector<Call>& calls);

/// Appends the wind's force on one cloth before a step, unless the density of air is 0.
void append_external_forces(const ClothModel& cloth, std::uint32_t index, std::uint32_t step,
                            std::uint32_t parity, std::vector<Call>& calls);

/// Appends the measures of the state copy `parity` of one cloth, reduced to one value.
void append_measures(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity, std::uint32_t step,
                     std::vector<Call>& calls);

/// Appends the drawing data of one cloth besides positions: normals and strains.
void append_drawing(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity,
                    std::vector<Call>& calls);

}  // namespace pliant
