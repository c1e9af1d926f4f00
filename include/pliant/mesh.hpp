// Triangle meshes: read, write, inspect.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pliant/vec3.hpp"

namespace pliant {

/// Indices of the three vertices of a triangle, counter-clockwise seen from the front.
using Triangle = std::array<std::uint32_t, 3>;

/// A triangle mesh as it stands in a file: every index is below `vertices.size()`, every coordinate is
/// finite.
struct SurfaceMesh {
    std::vector<Vec3> vertices;       ///< positions in m
    std::vector<Triangle> triangles;  ///< polygons are triangulated by the readers
    std::filesystem::path file = {};  ///< where it was read from; empty for a mesh made in code
};

/// Reads a mesh by the ending of its name: `.ply` (ASCII, binary little- and big-endian) or `.obj`.
/// Throws Error(bad_input) naming file, line (or byte) and value when the file is not exactly what it claims
/// to be.
SurfaceMesh read_mesh(const std::filesystem::path& file);

/// Writes a mesh by the ending of its name: `.ply` (binary little-endian) or `.obj`.
/// The file appears under its name only when it is complete. Throws Error(bad_input) when it cannot be
/// written.
void write_mesh(const std::filesystem::path& file, const SurfaceMesh& mesh);

/// What `pliant check MESH` tells.
struct MeshReport {
    std::size_t vertices = 0, edges = 0, triangles = 0;
    std::size_t components = 0;  ///< parts connected through shared vertices; isolated vertices not counted
    std::size_t isolated_vertices = 0;      ///< used by no triangle
    std::size_t boundary_edges = 0;         ///< edges with one triangle
    std::size_t boundary_loops = 0;         ///< connected chains of boundary edges
    std::size_t non_manifold_edges = 0;     ///< edges with three or more triangles
    std::size_t non_manifold_vertices = 0;  ///< vertices whose triangles form more than one fan
    std::size_t degenerate_triangles = 0;   ///< a vertex twice, or no area but float rounding
    std::size_t duplicate_triangles = 0;    ///< the same three vertices again, in any order
    std::size_t coincident_vertices = 0;    ///< vertices at exactly the position of an earlier one
    bool closed = false;                 ///< every edge has exactly two triangles, and every vertex one fan
    bool oriented = false;               ///< neighbours agree on the side they face
    long long euler_characteristic = 0;  ///< V - E + F over the used vertices
    double area = 0;                     ///< m^2
    double volume = 0;                   ///< m^3, signed; meaningful when closed and oriented
    double edge_min = 0, edge_mean = 0, edge_max = 0;  ///< m
    Vec3d bounds_min, bounds_max;                      ///< m
};

MeshReport inspect_mesh(const SurfaceMesh& mesh);

/// The report as lines for a person.
std::string describe(const MeshReport& report);

}  // namespace pliant
