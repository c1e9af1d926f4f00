// The edges between triangles, from which outlines of a surface are found.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pliant/mesh.hpp"
#include "pliant/vec3.hpp"

namespace pliant {

/// An edge: its two ends, and the third corner of the triangle on either side; `edges` in
/// shaders/cloth_nodes.glsl.
using SurfaceEdge = std::array<std::uint32_t, 4>;
constexpr std::uint32_t no_corner = ~0u;  ///< in place of the last one, at a border

/// Each edge once, oriented as in its first triangle (first end, second end, third corner). If more than two
/// triangles meet, the others count as borders.
std::vector<SurfaceEdge> edges_of(std::span<const Triangle> triangles);

}  // namespace pliant
