// Shapes made in code. All are centred on the origin, with y up; the closed ones face outward and have no
// coincident vertices.
#pragma once

#include <cstdint>

#include "pliant/api.hpp"
#include "pliant/mesh.hpp"

namespace pliant {

// Each function throws Error(bad_input) that names the option, its value and its range. Lengths are in m,
// above 0 and at most 1e4; a mesh has at most 2^24 vertices.

/// A sphere of circles of latitude, with poles on the y axis: 2 + (rings - 1) segments vertices.
struct UvSphereOptions {
    double radius = 0.5;          ///< m
    std::uint32_t rings = 32;     ///< 2 to 4096 bands from pole to pole
    std::uint32_t segments = 64;  ///< 3 to 8192 around the axis
};
PLIANT_API SurfaceMesh uv_sphere_mesh(const UvSphereOptions& options = {});

/// A sphere of nearly equal triangles: an icosahedron whose edges are divided into f parts, 10 f^2 + 2
/// vertices and 20 f^2 triangles.
struct IcosphereOptions {
    double radius = 0.5;           ///< m
    std::uint32_t frequency = 16;  ///< f, 1 to 1024 parts of each edge of the icosahedron
};
PLIANT_API SurfaceMesh icosphere_mesh(const IcosphereOptions& options = {});

/// A ring around the y axis: major_segments x minor_segments vertices, twice as many triangles.
struct TorusOptions {
    double major_radius = 0.5;          ///< m, of the centre line of the tube
    double minor_radius = 0.2;          ///< m, of the tube; below major_radius
    std::uint32_t major_segments = 64;  ///< 3 to 8192 around the y axis
    std::uint32_t minor_segments = 32;  ///< 3 to 8192 around the tube
};
PLIANT_API SurfaceMesh torus_mesh(const TorusOptions& options = {});

/// A box of n x n squares on each side, each cut in two: 6 n^2 + 2 vertices, 12 n^2 triangles. The diagonals
/// of neighbouring squares alternate, so that no direction is preferred. 8 faces make the cube of the volume
/// paper: 386 vertices, 768 triangles, 1,152 edges.
struct BoxOptions {
    Vec3d size = {1, 1, 1};   ///< m, along x, y, z
    std::uint32_t faces = 8;  ///< n, 1 to 1024 squares along each edge
};
PLIANT_API SurfaceMesh box_mesh(const BoxOptions& options = {});

/// A cylinder around the y axis with a half sphere at either end: 2 + segments (2 cap_rings + bands - 1)
/// vertices.
struct CapsuleOptions {
    double radius = 0.25;          ///< m
    double length = 0.5;           ///< m, of the cylinder; the whole is 2 radius longer
    std::uint32_t cap_rings = 12;  ///< 1 to 4096 bands of each half sphere
    std::uint32_t bands = 16;      ///< 1 to 4096 bands of the cylinder
    std::uint32_t segments = 48;   ///< 3 to 8192 around the axis
};
PLIANT_API SurfaceMesh capsule_mesh(const CapsuleOptions& options = {});

/// A flat rectangle in the x-z plane that faces up (+y): vertices row by row, row 0 at negative z, column 0
/// at negative x.
struct SheetMeshOptions {
    double width = 1;            ///< m, along x
    double height = 1;           ///< m, along z
    std::uint32_t rows = 32;     ///< vertices along z, 2 to 4096
    std::uint32_t columns = 32;  ///< vertices along x, 2 to 4096
};
PLIANT_API SurfaceMesh sheet_mesh(const SheetMeshOptions& options = {});

/// The same rectangle as an irregular mesh: inner vertices are moved by up to a fifth of the distance to
/// their neighbours, the same way in every run, and each square is cut along its shorter diagonal.
PLIANT_API SurfaceMesh irregular_sheet_mesh(const SheetMeshOptions& options = {});

/// An open tube around the y axis that faces outward: rows x segments vertices, row by row from the top,
/// every second row turned by half a segment. Triangles are nearly equal if length / (rows - 1) is 0.87 times
/// 2 pi radius / segments.
struct TubeOptions {
    double radius = 0.16;         ///< m
    double length = 1;            ///< m
    std::uint32_t rows = 64;      ///< 2 to 4096 circles along the axis
    std::uint32_t segments = 55;  ///< 3 to 8192 around it
};
PLIANT_API SurfaceMesh tube_mesh(const TubeOptions& options = {});

/// A T-shirt: two T-shaped panels, body and short sleeves, sewn along shoulders, sleeves and sides; open at
/// the neck (cut to a V in front), at both cuffs and at the hem. It stands upright (y), its front faces
/// positive z, and its triangles face outward. The panels are apart, as if inflated a little. Their squares
/// have sides s of width / (10 n), moved and cut as those of irregular_sheet_mesh: 320 n^2 + 22 n - 2
/// vertices, 640 n^2 triangles. In s: the body is 10 n wide and 13 n long, a sleeve 4 n by 4 n, the neck 4 n
/// wide and 2 n deep.
struct ShirtOptions {
    double width = 0.5;         ///< m, of the body
    std::uint32_t squares = 7;  ///< n, 1 to 200: squares along a tenth of the width
};
PLIANT_API SurfaceMesh shirt_mesh(const ShirtOptions& options = {});

/// A figure with body, head, ears, arms and legs, with smooth joints: one closed component without handles,
/// of nearly equal, well-shaped triangles. It stands upright (y) and faces positive z.
struct BlobOptions {
    double height = 1;                ///< m, from the feet to the tips of the ears
    std::uint32_t vertices = 10'000;  ///< 1,000 to 500,000; the mesh has this many within 5 %
};
PLIANT_API SurfaceMesh blob_mesh(const BlobOptions& options = {});

}  // namespace pliant
