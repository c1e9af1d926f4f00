// Merges coincident vertices.
#pragma once

#include <cstddef>

#include "pliant/api.hpp"
#include "pliant/mesh.hpp"

namespace pliant {

/// Merges each vertex with an earlier remaining one within the tolerance (m; 0: exactly the same position).
/// Returns the number of removed vertices; triangles may then have a vertex twice.
PLIANT_INSIDE std::size_t weld_vertices(SurfaceMesh& mesh, double tolerance);

/// Drops vertices without triangles, and returns their number.
std::size_t drop_isolated_vertices(SurfaceMesh& mesh);

}  // namespace pliant
