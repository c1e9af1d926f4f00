// A surface where a function of space is 0, as a mesh of well-shaped triangles.
#pragma once

#include "pliant/mesh.hpp"

namespace pliant {

/// A function of space about as long as the way to its zero surface, negative inside.
struct FieldSample {
    double value = 0;  ///< m
    Vec3d gradient;    ///< of a length of about 1, never above `steepest`
};
using Field = FieldSample (*)(Vec3d);

struct Bounds {
    Vec3d min, max;  ///< m
};

/// The zero surface of a field whose inside lies within the bounds, with about the number of vertices asked
/// for (within 5 %): closed, without a handle, in one component, facing outward. Throws Error(bad_input) that
/// begins with `name` when no such surface is found, as where the number is too small. The same in every run.
SurfaceMesh implicit_surface_mesh(const char* name, Field field, const Bounds& bounds,
                                  std::uint32_t vertex_count);

}  // namespace pliant
