// Where each node of a cloth lies on the checker that it is printed with.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pliant/scene.hpp"

namespace pliant {

/// Squares across the shorter side of a cloth.
constexpr double pattern_squares = 16;

/// For each node its place in squares. A sheet is measured by row and column, a mesh along the two longest
/// edges of the box around it at rest.
std::vector<std::array<float, 2>> cloth_pattern(const Cloth& cloth, std::uint32_t rows, std::uint32_t columns,
                                                std::uint32_t node_count);

}  // namespace pliant
