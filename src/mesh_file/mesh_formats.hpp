// Shared by the mesh readers and writers; private to src/mesh.
#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <string_view>

#include "pliant/mesh.hpp"

namespace pliant {

/// A file in memory, with its name for messages.
struct MeshSource {
    std::string name;
    std::string_view bytes;
};

/// Throw Error(bad_input): "name, line 12: message".
[[noreturn]] void mesh_error(const MeshSource& source, const std::string& message);
[[noreturn]] void mesh_error_at_line(const MeshSource& source, std::size_t line, const std::string& message);
[[noreturn]] void mesh_error_at_byte(const MeshSource& source, std::size_t byte, const std::string& message);

SurfaceMesh read_ply(const MeshSource& source);
std::vector<float> read_ply_attribute(const MeshSource& source, const std::string& name);
SurfaceMesh read_obj(const MeshSource& source);
SurfaceMesh read_stl(const MeshSource& source);
SurfaceMesh read_off(const MeshSource& source);
SurfaceMesh read_gltf(const MeshSource& source);

void write_ply(std::ostream& out, const SurfaceMesh& mesh);
void write_obj(std::ostream& out, const SurfaceMesh& mesh);

}  // namespace pliant
