// Number formatting for reports on meshes; private to src/mesh.
#pragma once

#include <cstddef>
#include <string>

#include "pliant/vec3.hpp"

namespace pliant {

/// Six significant digits.
std::string rounded(double value);
std::string rounded(Vec3d v);

/// "1 edge", "2 edges"
std::string counted(std::size_t count, const std::string& one, const std::string& many);

}  // namespace pliant
