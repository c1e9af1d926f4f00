// Triangle meshes: read, write, inspect, repair.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pliant/api.hpp"
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

/// Reads a mesh by the ending of its name: `.ply` (ASCII, binary little- and big-endian), `.obj`, and through
/// assimp `.stl`, `.off`, `.gltf` and `.glb`. Vertices at one place of an STL or glTF file are made one:
/// these formats store them again for every triangle or seam. What a node of a glTF scene moves is moved.
/// Throws Error(bad_input) naming file, line (or byte) and value when the file is not exactly what it claims
/// to be.
PLIANT_API SurfaceMesh read_mesh(const std::filesystem::path& file);

/// Whether the name ends as read_mesh asks.
PLIANT_API bool is_mesh_file(const std::filesystem::path& file);

/// Reads a number of each vertex, a property of element 'vertex' of a `.ply` file, in the order of the
/// vertices. Throws Error(bad_input) as read_mesh does, and when there is no property of that name.
PLIANT_API std::vector<float> read_vertex_attribute(const std::filesystem::path& file,
                                                    const std::string& name);

/// Writes a mesh by the ending of its name: `.ply` (binary little-endian) or `.obj`.
/// The file appears under its name only when it is complete. Throws Error(bad_input) when it cannot be
/// written.
PLIANT_API void write_mesh(const std::filesystem::path& file, const SurfaceMesh& mesh);

/// A connected chain of boundary edges: the rim of a hole, or the hem of a cloth.
struct BoundaryLoop {
    std::uint32_t vertex = 0;  ///< the lowest on it
    Vec3d position;            ///< m, of that vertex
    std::size_t edges = 0;
    double length = 0;  ///< m
};

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
    bool closed = false;      ///< every edge has exactly two triangles, and every vertex one fan
    bool oriented = false;    ///< neighbours agree on the side they face
    bool orientable = false;  ///< they could be made to agree
    std::size_t inward_components =
        0;  ///< closed ones that are inside out; a cavity that faces inward is not
    long long euler_characteristic = 0;  ///< V - E + F over the used vertices
    long long genus = 0;                 ///< handles of all components; meaningful when closed and orientable
    double area = 0;                     ///< m^2
    double volume = 0;                   ///< m^3, signed; meaningful when closed and oriented
    double edge_min = 0, edge_mean = 0, edge_max = 0;  ///< m
    Vec3d bounds_min, bounds_max;                      ///< m
    std::vector<BoundaryLoop> loops;                   ///< by their vertex
    /// Vertices where trouble is, meaningful when it was counted above.
    std::array<std::uint32_t, 2> first_non_manifold_edge{};
    std::uint32_t first_non_manifold_vertex = 0;
    std::uint32_t first_disagreement = 0;  ///< on an edge whose triangles face different sides
};

/// Throws Error(bad_input) when an index has no vertex or a coordinate is not finite.
PLIANT_API MeshReport inspect_mesh(const SurfaceMesh& mesh);

/// The report as lines for a person.
PLIANT_API std::string describe(const MeshReport& report);

/// What repair_mesh may do.
struct RepairOptions {
    double weld_tolerance = 0;  ///< m, 0 to 1e4; vertices this close to an earlier one become that one
    bool fill_holes = false;    ///< close boundary loops
};

/// What repair_mesh did.
struct RepairReport {
    std::size_t welded_vertices = 0;
    std::size_t dropped_triangles = 0;    ///< degenerate ones
    std::size_t flipped_edges = 0;        ///< the longest edge of a triangle without area, turned to end it
    std::size_t duplicate_triangles = 0;  ///< dropped, all but the first
    std::size_t isolated_vertices = 0;    ///< dropped
    std::size_t turned_triangles = 0;     ///< for neighbours to agree and components to face outward
    std::size_t filled_holes = 0;
    std::size_t added_triangles = 0, added_vertices = 0;  ///< in the holes
    std::size_t open_loops = 0;                           ///< boundary loops that are left
};

/// Mends a mesh in this order: welds vertices, drops degenerate and duplicate triangles and isolated
/// vertices, turns triangles so that neighbours agree, fills holes when asked, and makes each closed
/// component face outward (inward when it is a cavity of another). A mesh that is closed stays closed: what
/// would open it is not done. Edges with three or more triangles, vertices with more than one fan and
/// surfaces that cannot be oriented stay as they are. Throws Error(bad_input) as inspect_mesh does, or for a
/// tolerance out of range.
PLIANT_API RepairReport repair_mesh(SurfaceMesh& mesh, const RepairOptions& options = {});

/// The report as lines for a person; without any, nothing is to be done.
PLIANT_API std::string describe(const RepairReport& report);

/// For a body with volume: throws Error(bad_input) unless the mesh is closed, manifold and consistently
/// oriented, faces outward, encloses a volume, and has no unused vertex and no edge of length 0. The message
/// says where it fails and which command mends it. `name`: of the file, or of the shape of a mesh made in
/// code.
PLIANT_API void require_closed(const SurfaceMesh& mesh, const std::string& name);

}  // namespace pliant
