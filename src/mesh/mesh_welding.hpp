// Vertices at one place made one.
#pragma once

#include <cstddef>

#include "pliant/api.hpp"
#include "pliant/mesh.hpp"

namespace pliant {

/// Vertices within the tolerance (m; 0: exactly the same position) of an earlier one that stays become that
/// one. Returns how many are gone; triangles may now have a vertex twice.
PLIANT_INSIDE std::size_t weld_vertices(SurfaceMesh& mesh, double tolerance);

/// Drops the vertices that no triangle uses, and returns their number.
std::size_t drop_isolated_vertices(SurfaceMesh& mesh);

}  // namespace pliant
