// Words for numbers, as the reports on meshes use them; private to src/mesh.
#pragma once

#include <cstddef>
#include <string>

#include "pliant/vec3.hpp"

namespace pliant {

/// Six digits, as a person reads them.
std::string rounded(double value);
std::string rounded(Vec3d v);

/// "1 edge", "2 edges"
std::string counted(std::size_t count, const std::string& one, const std::string& many);

}  // namespace pliant
