// The position of each node in a cloth's checker pattern.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pliant/scene.hpp"

namespace pliant {

/// Squares across the shorter side of a cloth.
constexpr double pattern_squares = 16;

/// The position of each node, in squares: by row and column of a sheet; for a mesh, along the two longest
/// edges of its bounding box at rest.
std::vector<std::array<float, 2>> cloth_pattern(const Cloth& cloth, std::uint32_t rows, std::uint32_t columns,
                                                std::uint32_t node_count);

}  // namespace pliant
