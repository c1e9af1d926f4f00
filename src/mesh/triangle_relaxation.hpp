// Makes the triangles of a surface mesh more regular.
#pragma once

#include "mesh/implicit_surface.hpp"

namespace pliant {

/// Moves the vertices of a closed manifold along the zero surface of the field towards the middle of their
/// neighbours, and flips edges until the triangles are nearly Delaunay. Keeps the numbers of vertices and
/// triangles. `spacing` in m: about the length of an edge; the maximum displacement of a vertex per
/// iteration.
void relax_triangles(SurfaceMesh& mesh, Field field, double spacing);

}  // namespace pliant
