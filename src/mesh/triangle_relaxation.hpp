// Triangles of a surface mesh made alike.
#pragma once

#include "mesh/implicit_surface.hpp"

namespace pliant {

/// Moves the vertices of a closed manifold along the zero surface of the field towards the middle of their
/// neighbours, and flips edges until the triangles are about Delaunay. Numbers of vertices and triangles
/// stay. `spacing` in m: about the length of an edge; no vertex moves further at once.
void relax_triangles(SurfaceMesh& mesh, Field field, double spacing);

}  // namespace pliant
