// Closes boundary loops of a surface with triangles.
#pragma once

#include <cstddef>

#include "pliant/mesh.hpp"

namespace pliant {

struct HoleFilling {
    std::size_t holes = 0, triangles = 0, vertices = 0;  ///< filled, added, added
};

/// Closes each boundary loop of a mesh whose neighbours agree: a loop of up to 400 vertices by the
/// triangulation of least area that adds no vertex; a longer one, or one without such a triangulation, by a
/// fan about a new vertex in its middle. Loops that touch an edge with three or more triangles, or a surface
/// that cannot be oriented, stay open.
HoleFilling fill_holes(SurfaceMesh& mesh);

}  // namespace pliant
