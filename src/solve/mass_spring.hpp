// The mass-spring method as sequences of passes; it knows no backend.
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

/// Appends the motion of the nodes that moving pins hold, to where they are at the end of a step.
void append_attachments(const ClothModel& cloth, std::uint32_t index, std::uint32_t step,
                        std::uint32_t parity, std::vector<Call>& calls);

/// Appends the forces from outside on one cloth before a step: of the wind, where there is air, and loads.
void append_external_forces(const ClothModel& cloth, std::uint32_t index, std::uint32_t step,
                            std::uint32_t parity, std::vector<Call>& calls);

/// Appends the measures of the state copy `parity` of one cloth, reduced to one value.
void append_measures(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity, std::uint32_t step,
                     std::vector<Call>& calls);

/// Appends what drawing one cloth needs beside its positions: normals and strains.
void append_drawing(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity,
                    std::vector<Call>& calls);

}  // namespace pliant
