// Well-shaped triangle meshes of the zero surfaces of functions of space.
#pragma once

#include "pliant/mesh.hpp"

namespace pliant {

/// An approximate signed distance to the zero surface, negative inside.
struct FieldSample {
    double value = 0;  ///< m
    Vec3d gradient;    ///< of length about 1, never above `steepest`
};
using Field = FieldSample (*)(Vec3d);

struct Bounds {
    Vec3d min, max;  ///< m
};

/// The zero surface of a field whose inside is within the bounds, with about the given number of vertices
/// (within 5 %): closed, without handles, one component, facing outward. The same in every run. Throws
/// Error(bad_input), which begins with `name`, if no such surface is found, for example if the number is too
/// small.
SurfaceMesh implicit_surface_mesh(const char* name, Field field, const Bounds& bounds,
                                  std::uint32_t vertex_count);

}  // namespace pliant
