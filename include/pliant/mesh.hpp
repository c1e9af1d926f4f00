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

/// A triangle mesh: every index is below `vertices.size()`, every coordinate is finite.
struct SurfaceMesh {
    std::vector<Vec3> vertices;       ///< positions in m
    std::vector<Triangle> triangles;  ///< the readers triangulate polygons
    std::filesystem::path file = {};  ///< the file it was read from; empty if made in code
};

/// Reads a mesh; the file's extension chooses the format: `.ply` (ASCII, binary little- and big-endian),
/// `.obj`, and through assimp `.stl`, `.off`, `.gltf` and `.glb`. Coincident vertices of an STL or glTF file
/// are welded: these formats repeat them for every triangle or seam. Transformations of a glTF scene's nodes
/// are applied. Throws Error(bad_input) naming file, line (or byte) and value if the file violates its
/// format.
PLIANT_API SurfaceMesh read_mesh(const std::filesystem::path& file);

/// Whether the file's extension is one that read_mesh accepts.
PLIANT_API bool is_mesh_file(const std::filesystem::path& file);

/// Reads a number of each vertex, a property of element 'vertex' of a `.ply` file, in the order of the
/// vertices. Throws Error(bad_input) as read_mesh does, and when there is no property of that name.
PLIANT_API std::vector<float> read_vertex_attribute(const std::filesystem::path& file,
                                                    const std::string& name);

/// Writes a mesh; the file's extension chooses the format: `.ply` (binary little-endian) or `.obj`. The file
/// appears under its name only when it is complete. Throws Error(bad_input) if it cannot be written.
PLIANT_API void write_mesh(const std::filesystem::path& file, const SurfaceMesh& mesh);

/// A connected chain of boundary edges: the rim of a hole, or the hem of a cloth.
struct BoundaryLoop {
    std::uint32_t vertex = 0;  ///< the lowest index on it
    Vec3d position;            ///< m, of that vertex
    std::size_t edges = 0;
    double length = 0;  ///< m
};

/// The report of `pliant check MESH`.
struct MeshReport {
    std::size_t vertices = 0, edges = 0, triangles = 0;
    std::size_t components = 0;  ///< parts connected through shared vertices; without isolated vertices
    std::size_t isolated_vertices = 0;      ///< used by no triangle
    std::size_t boundary_edges = 0;         ///< edges with one triangle
    std::size_t boundary_loops = 0;         ///< connected chains of boundary edges
    std::size_t non_manifold_edges = 0;     ///< edges with three or more triangles
    std::size_t non_manifold_vertices = 0;  ///< vertices whose triangles form more than one fan
    std::size_t degenerate_triangles = 0;   ///< a repeated vertex, or no area beyond float rounding
    std::size_t duplicate_triangles = 0;    ///< the same three vertices again, in any order
    std::size_t coincident_vertices = 0;    ///< vertices at exactly the position of an earlier one
    bool closed = false;      ///< every edge has exactly two triangles, and every vertex one fan
    bool oriented = false;    ///< neighbouring triangles face the same side
    bool orientable = false;  ///< its triangles can be turned to face the same side
    std::size_t inward_components =
        0;  ///< closed components that are inside out; without cavities, which face inward correctly
    long long euler_characteristic = 0;  ///< V - E + F over the used vertices
    long long genus = 0;                 ///< total number of handles; meaningful if closed and orientable
    double area = 0;                     ///< m^2
    double volume = 0;                   ///< m^3, signed; meaningful if closed and oriented
    double edge_min = 0, edge_mean = 0, edge_max = 0;  ///< m
    Vec3d bounds_min, bounds_max;                      ///< m
    std::vector<BoundaryLoop> loops;                   ///< by their vertex
    /// Vertices at the first defects; meaningful if their counts above are not 0.
    std::array<std::uint32_t, 2> first_non_manifold_edge{};
    std::uint32_t first_non_manifold_vertex = 0;
    std::uint32_t first_disagreement = 0;  ///< on an edge whose triangles face different sides
};

/// Throws Error(bad_input) if an index is out of range or a coordinate is not finite.
PLIANT_API MeshReport inspect_mesh(const SurfaceMesh& mesh);

/// The report as text, in lines.
PLIANT_API std::string describe(const MeshReport& report);

/// Options of repair_mesh.
struct RepairOptions {
    double weld_tolerance = 0;  ///< m, 0 to 1e4; vertices this close to an earlier one are merged with it
    bool fill_holes = false;    ///< close boundary loops
};

/// Changes made by repair_mesh.
struct RepairReport {
    std::size_t welded_vertices = 0;
    std::size_t dropped_triangles = 0;    ///< degenerate ones
    std::size_t flipped_edges = 0;        ///< the longest edge of a triangle without area is flipped to
                                          ///< remove the triangle
    std::size_t duplicate_triangles = 0;  ///< dropped, all but the first
    std::size_t isolated_vertices = 0;    ///< dropped
    std::size_t turned_triangles = 0;     ///< so that neighbours agree and components face outward
    std::size_t filled_holes = 0;
    std::size_t added_triangles = 0, added_vertices = 0;  ///< in the holes
    std::size_t open_loops = 0;                           ///< remaining boundary loops
};

/// Repairs a mesh in this order: welds vertices, drops degenerate and duplicate triangles and isolated
/// vertices, turns triangles so that neighbours agree, fills holes if asked, and makes each closed component
/// face outward (inward if it is a cavity of another). A closed mesh stays closed: changes that would open it
/// are skipped. Edges with three or more triangles, vertices with more than one fan and surfaces that cannot
/// be oriented are left unchanged. Throws Error(bad_input) as inspect_mesh does, or for a tolerance out of
/// range.
PLIANT_API RepairReport repair_mesh(SurfaceMesh& mesh, const RepairOptions& options = {});

/// The report as text, in lines; empty if nothing was changed.
PLIANT_API std::string describe(const RepairReport& report);

/// For a body with volume: throws Error(bad_input) unless the mesh is closed, manifold and consistently
/// oriented, faces outward, encloses a volume, and has no unused vertex and no edge of length 0. The message
/// says where it fails and which command repairs it. `name`: of the file, or of the shape of a mesh made in
/// code.
PLIANT_API void require_closed(const SurfaceMesh& mesh, const std::string& name);

}  // namespace pliant
