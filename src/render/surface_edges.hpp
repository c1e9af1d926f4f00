// The edges between triangles: where a picture looks for the outlines of a surface.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pliant/mesh.hpp"
#include "pliant/vec3.hpp"

namespace pliant {

/// An edge: its ends, and the third corner of the triangle on either side; `edges` in
/// shaders/cloth_nodes.glsl.
using SurfaceEdge = std::array<std::uint32_t, 4>;
constexpr std::uint32_t no_corner = ~0u;  ///< instead of the last one, at a border

/// Each edge once, seen from its first triangle, whose corners are its ends and the third in their order.
/// Where more than two triangles meet, those beyond are taken for borders.
std::vector<SurfaceEdge> edges_of(std::span<const Triangle> triangles);

}  // namespace pliant
