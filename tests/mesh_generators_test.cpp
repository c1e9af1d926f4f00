// Shapes made in code, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "pliant/mesh_generators.hpp"
#include "test_differences.hpp"
#include "test_errors.hpp"

namespace pliant {
namespace {

constexpr double pi = std::numbers::pi;

/// Closed, without a seam or any fault, and facing outward.
MeshReport sound_report(const SurfaceMesh& mesh, std::size_t vertices, std::size_t triangles,
                        long long euler_characteristic)
{
    const MeshReport report = inspect_mesh(mesh);
    EXPECT_EQ(report.vertices, vertices);
    EXPECT_EQ(report.triangles, triangles);
    EXPECT_EQ(report.edges, triangles * 3 / 2);
    EXPECT_EQ(report.euler_characteristic, euler_characteristic);
    EXPECT_EQ(report.components, 1u);
    EXPECT_TRUE(report.closed);
    EXPECT_TRUE(report.oriented);
    EXPECT_GT(report.volume, 0);
    EXPECT_EQ(report.isolated_vertices + report.degenerate_triangles + report.duplicate_triangles +
                  report.coincident_vertices,
              0u);
    return report;
}

/// The volume of a mesh inscribed in a smooth shape is too small by an amount that goes with the square of
/// the edge length: the error falls by 4 when the edges are halved, up to terms of fourth order (relative
/// h^2, below 1 % at 32 parts of a circle).
void expect_second_order(double coarse, double fine, double exact)
{
    EXPECT_LT(coarse, exact);
    EXPECT_LT(fine, exact);
    EXPECT_NEAR((exact - coarse) / (exact - fine), 4, 0.05);
}

double volume_of(const SurfaceMesh& mesh) { return inspect_mesh(mesh).volume; }

// ---- the parametric shapes

TEST(MeshGenerators, uv_sphere)
{
    for (const auto& [rings, segments] : {std::pair{2u, 3u}, {3u, 5u}, {32u, 64u}, {101u, 7u}})
        sound_report(uv_sphere_mesh({0.3, rings, segments}), 2 + (rings - 1) * segments,
                     2 * (rings - 1) * segments, 2);
    const double exact = 4.0 / 3 * pi * 0.3 * 0.3 * 0.3;
    expect_second_order(volume_of(uv_sphere_mesh({0.3, 32, 64})), volume_of(uv_sphere_mesh({0.3, 64, 128})),
                        exact);
    for (const Vec3 v : uv_sphere_mesh({2, 9, 11}).vertices)
        EXPECT_NEAR(std::sqrt(dot(to_double(v), to_double(v))), 2, 4e-7);  // two roundings of float
}

TEST(MeshGenerators, icosphere)
{
    for (const std::uint32_t f : {1u, 2u, 3u, 7u, 16u, 50u}) {
        SCOPED_TRACE(f);
        const SurfaceMesh mesh = icosphere_mesh({1, f});
        const MeshReport report = sound_report(mesh, 10 * f * f + 2, 20 * f * f, 2);
        EXPECT_LT(report.edge_max, 1.2 * report.edge_min);  // what evenly divided arcs are for
        for (const Vec3 v : mesh.vertices) EXPECT_NEAR(std::sqrt(dot(to_double(v), to_double(v))), 1, 2e-7);
    }
    // The icosahedron of radius 1: edge a = 1 / sin(2 pi / 5), volume 5 (3 + sqrt 5) / 12 a^3.
    const double a = 1 / std::sin(2 * pi / 5);
    EXPECT_NEAR(volume_of(icosphere_mesh({1, 1})), 5 * (3 + std::sqrt(5.0)) / 12 * a * a * a, 1e-6);
    expect_second_order(volume_of(icosphere_mesh({1, 16})), volume_of(icosphere_mesh({1, 32})), 4.0 / 3 * pi);
}

TEST(MeshGenerators, torus)
{
    for (const auto& [around, tube] : {std::pair{3u, 3u}, {5u, 4u}, {64u, 32u}})
        sound_report(torus_mesh({0.5, 0.2, around, tube}), around * tube, 2 * around * tube, 0);
    expect_second_order(volume_of(torus_mesh({0.5, 0.2, 64, 32})), volume_of(torus_mesh({0.5, 0.2, 128, 64})),
                        2 * pi * pi * 0.5 * 0.2 * 0.2);
}

TEST(MeshGenerators, box)
{
    for (const std::uint32_t n : {1u, 2u, 3u, 8u, 17u}) {
        SCOPED_TRACE(n);
        const MeshReport report = sound_report(box_mesh({{0.5, 1, 2}, n}), 6 * n * n + 2, 12 * n * n, 2);
        EXPECT_NEAR(report.volume, 1, 1e-6);
        EXPECT_NEAR(report.area, 7, 1e-6);
        EXPECT_EQ(report.bounds_min, (Vec3d{-0.25, -0.5, -1}));
        EXPECT_EQ(report.bounds_max, (Vec3d{0.25, 0.5, 1}));
    }
    const MeshReport cube = inspect_mesh(box_mesh());  // the one of the volume paper
    EXPECT_EQ(cube.vertices, 386u);
    EXPECT_EQ(cube.triangles, 768u);
    EXPECT_EQ(cube.edges, 1152u);
    EXPECT_NEAR(cube.volume, 1, 1e-12);
}

TEST(MeshGenerators, capsule)
{
    for (const auto& [rings, bands, segments] : {std::tuple{1u, 1u, 3u}, {2u, 1u, 5u}, {12u, 16u, 48u}})
        sound_report(capsule_mesh({0.25, 0.5, rings, bands, segments}),
                     2 + segments * (2 * rings + bands - 1), 2 * segments * (2 * rings + bands - 1), 2);
    const double exact = pi * 0.25 * 0.25 * 0.5 + 4.0 / 3 * pi * 0.25 * 0.25 * 0.25;
    expect_second_order(volume_of(capsule_mesh({0.25, 0.5, 16, 1, 64})),
                        volume_of(capsule_mesh({0.25, 0.5, 32, 1, 128})), exact);
    EXPECT_EQ(inspect_mesh(capsule_mesh()).bounds_max.y, 0.5);
}

TEST(MeshGenerators, sheet_faces_up)
{
    const SurfaceMesh mesh = sheet_mesh({2, 0.5, 5, 9});
    const MeshReport report = inspect_mesh(mesh);
    EXPECT_EQ(report.vertices, 45u);
    EXPECT_EQ(report.triangles, 64u);
    EXPECT_EQ(report.boundary_edges, 24u);
    EXPECT_EQ(report.euler_characteristic, 1);
    EXPECT_TRUE(report.oriented);
    EXPECT_NEAR(report.area, 1, 1e-7);
    EXPECT_EQ(mesh.vertices[0], (Vec3{-1, 0, -0.25f}));
    EXPECT_EQ(mesh.vertices[8], (Vec3{1, 0, -0.25f}));
    for (const Triangle& t : mesh.triangles) {
        const Vec3d a = to_double(mesh.vertices[t[0]]), b = to_double(mesh.vertices[t[1]]),
                    c = to_double(mesh.vertices[t[2]]);
        EXPECT_GT(cross(b - a, c - a).y, 0);
    }
}

// ---- pieces of cloth

/// One oriented piece with so many hems, without any fault.
MeshReport hemmed_report(const SurfaceMesh& mesh, std::size_t vertices, std::size_t triangles,
                         std::size_t hems, std::size_t hem_edges)
{
    const MeshReport report = inspect_mesh(mesh);
    EXPECT_EQ(report.vertices, vertices);
    EXPECT_EQ(report.triangles, triangles);
    EXPECT_EQ(report.components, 1u);
    EXPECT_TRUE(report.oriented);
    EXPECT_EQ(report.boundary_loops, hems);
    EXPECT_EQ(report.boundary_edges, hem_edges);
    EXPECT_EQ(report.euler_characteristic, 2 - static_cast<long long>(hems));  // a sphere with holes
    EXPECT_EQ(report.isolated_vertices + report.non_manifold_edges + report.non_manifold_vertices +
                  report.degenerate_triangles + report.duplicate_triangles + report.coincident_vertices,
              0u);
    return report;
}

/// Twice the area of a triangle along its normal.
Vec3d normal_of(const SurfaceMesh& mesh, const Triangle& t)
{
    const Vec3d a = to_double(mesh.vertices[t[0]]);
    return cross(to_double(mesh.vertices[t[1]]) - a, to_double(mesh.vertices[t[2]]) - a);
}

TEST(MeshGenerators, irregular_sheet)
{
    for (const auto& [rows, columns] : {std::pair{2u, 2u}, {3u, 8u}, {40u, 40u}, {126u, 126u}}) {
        const double side = 1.0 / (rows - 1);
        const SurfaceMesh mesh = irregular_sheet_mesh({side * (columns - 1), 1, rows, columns});
        const MeshReport report = hemmed_report(mesh, rows * columns, 2 * (rows - 1) * (columns - 1), 1,
                                                2 * (rows - 1) + 2 * (columns - 1));
        EXPECT_NEAR(report.area, side * (columns - 1), 1e-5);
        EXPECT_GT(report.edge_min, 0.6 * side);
        EXPECT_LT(report.edge_max, 1.75 * side);
        for (const Triangle& t : mesh.triangles) EXPECT_GT(normal_of(mesh, t).y, 0.3 * side * side);
        EXPECT_EQ(mesh.vertices.front(),
                  sheet_mesh({side * (columns - 1), 1, rows, columns}).vertices.front());
    }
    // Irregular: no two squares alike.
    const MeshReport report = inspect_mesh(irregular_sheet_mesh({1, 1, 40, 40}));
    EXPECT_GT(report.edge_max, 2 * report.edge_min);
}

TEST(MeshGenerators, tube)
{
    for (const auto& [rows, segments] : {std::pair{2u, 3u}, {3u, 5u}, {64u, 55u}, {120u, 131u}})
        hemmed_report(tube_mesh({0.16, 1, rows, segments}), rows * segments, 2 * (rows - 1) * segments, 2,
                      2 * segments);
    const SurfaceMesh mesh = tube_mesh();
    const MeshReport report = inspect_mesh(mesh);
    EXPECT_LT(report.edge_max, 1.01 * report.edge_min);
    EXPECT_EQ(report.bounds_max.y, 0.5);
    EXPECT_EQ(report.bounds_min.y, -0.5);
    EXPECT_NEAR(report.area, 2 * pi * 0.16, 2e-3);
    for (const Triangle& t : mesh.triangles) {
        const Vec3d out = to_double(mesh.vertices[t[0]]);
        EXPECT_GT(dot(normal_of(mesh, t), {out.x, 0, out.z}), 0);
    }
}

TEST(MeshGenerators, shirt)
{
    for (const std::uint32_t n : {1u, 2u, 3u, 7u}) {
        SCOPED_TRACE(n);
        const double side = 0.5 / (10 * n);
        const SurfaceMesh mesh = shirt_mesh({0.5, n});
        const MeshReport report =
            hemmed_report(mesh, 320 * n * n + 22 * n - 2, 640 * n * n, 4, (20 + 16 + 8) * n);
        EXPECT_GT(report.edge_min, 0.6 * side);
        EXPECT_LT(report.edge_max, 2.1 * side);
        EXPECT_NEAR(report.bounds_max.x, 0.45, 1e-6);
        EXPECT_NEAR(report.bounds_max.y, 0.325, 1e-6);
        EXPECT_NEAR(report.bounds_min.y, -0.325, 1e-6);
        // Hem and cuffs by their length around, the neck by its V and the back's straight edge.
        std::vector<double> loops;
        for (const BoundaryLoop& loop : report.loops) loops.push_back(static_cast<double>(loop.edges) / n);
        std::sort(loops.begin(), loops.end());
        EXPECT_EQ(loops, (std::vector<double>{8, 8, 8, 20}));
        // The front faces to positive z, the back to negative z: outward.
        for (const Triangle& t : mesh.triangles) {
            const Vec3d normal = normal_of(mesh, t);
            double z = 0;
            for (const std::uint32_t corner : t) z += double{mesh.vertices[corner].z};
            EXPECT_GT(normal.z * z, 0);
            EXPECT_GT(dot(normal, normal), 0.09 * side * side * side * side);
        }
    }
}

TEST(MeshGenerators, cloth_is_the_same_every_time)
{
    EXPECT_EQ(shirt_mesh({0.6, 3}).vertices, shirt_mesh({0.6, 3}).vertices);
    EXPECT_EQ(irregular_sheet_mesh().vertices, irregular_sheet_mesh().vertices);
    EXPECT_EQ(irregular_sheet_mesh().triangles, irregular_sheet_mesh().triangles);
}

// ---- the figure

double smallest_angle(const SurfaceMesh& mesh)
{
    test::Largest cosine;
    for (const Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3d tip = to_double(mesh.vertices[t[k]]);
            const Vec3d u = to_double(mesh.vertices[t[(k + 1) % 3]]) - tip,
                        v = to_double(mesh.vertices[t[(k + 2) % 3]]) - tip;
            cosine.add(dot(u, v) / std::sqrt(dot(u, u) * dot(v, v)));
        }
    return std::acos(cosine.value()) * 180 / pi;
}

TEST(MeshGenerators, blob_is_one_well_shaped_ball_of_any_resolution)
{
    for (const std::uint32_t count : {1000u, 1230u, 1777u, 2500u, 4321u, 8000u, 35000u}) {
        SCOPED_TRACE(count);
        const SurfaceMesh mesh = blob_mesh({1, count});
        const auto n = mesh.vertices.size();
        EXPECT_NEAR(static_cast<double>(n), count, 0.05 * count);
        const MeshReport report = sound_report(mesh, n, 2 * n - 4, 2);
        // Found over 217 numbers from 1,000 to 6,000: never below a fifth of the mean.
        EXPECT_GT(report.edge_min, 0.2 * report.edge_mean);
        EXPECT_LT(report.edge_max, 2 * report.edge_mean);
        EXPECT_GT(smallest_angle(mesh), 20);
        EXPECT_NEAR(report.bounds_max.y, 0.5, 1e-6);
        EXPECT_NEAR(report.bounds_min.y, -0.5, 1e-6);
    }
}

TEST(MeshGenerators, blob_converges)
{
    // The error of an inscribed surface goes with the square of the edge length, with 1 / vertices. The
    // meshes are not nested, and the height of each is made 1, hence the factor of 2.
    const double coarse = volume_of(blob_mesh({1, 2500})), middle = volume_of(blob_mesh({1, 10'000})),
                 fine = volume_of(blob_mesh({1, 40'000}));
    EXPECT_LT(std::abs(fine - middle), std::abs(fine - coarse) / 2);
    EXPECT_NEAR(middle, fine, 2e-3 * fine);
    EXPECT_NEAR(volume_of(blob_mesh({2, 2500})), 8 * coarse, 1e-5 * coarse);
}

TEST(MeshGenerators, the_same_every_time)
{
    const SurfaceMesh first = blob_mesh({0.7, 3000}), second = blob_mesh({0.7, 3000});
    EXPECT_EQ(first.vertices, second.vertices);
    EXPECT_EQ(first.triangles, second.triangles);
}

// ---- what cannot be made

TEST(MeshGenerators, bad_options_are_named)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_ERROR(uv_sphere_mesh({-1, 8, 8}), bad_input, "uv_sphere.radius is -1 m, but must be above 0");
    EXPECT_ERROR(uv_sphere_mesh({nan, 8, 8}), bad_input, "uv_sphere.radius");
    EXPECT_ERROR(uv_sphere_mesh({1, 1, 8}), bad_input, "uv_sphere.rings is 1");
    EXPECT_ERROR(uv_sphere_mesh({1, 8, 2}), bad_input, "uv_sphere.segments is 2");
    EXPECT_ERROR(uv_sphere_mesh({1, 4096, 8192}), bad_input, "uv_sphere would have 33546242 vertices");
    EXPECT_ERROR(icosphere_mesh({0, 8}), bad_input, "icosphere.radius is 0 m");
    EXPECT_ERROR(icosphere_mesh({1, 0}), bad_input, "icosphere.frequency is 0");
    EXPECT_ERROR(icosphere_mesh({1, 1025}), bad_input, "between 1 and 1024");
    EXPECT_ERROR(torus_mesh({0.5, 0.5, 8, 8}), bad_input, "torus.minor_radius is 0.5 m, but must be below");
    EXPECT_ERROR(torus_mesh({1, 0.5, 2, 8}), bad_input, "torus.major_segments is 2");
    EXPECT_ERROR(torus_mesh({1, 0.5, 8, 2}), bad_input, "torus.minor_segments is 2");
    EXPECT_ERROR(box_mesh({{1, 0, 1}, 8}), bad_input, "box.size.y is 0 m");
    EXPECT_ERROR(box_mesh({{1, 1, 1}, 0}), bad_input, "box.faces is 0");
    EXPECT_ERROR(capsule_mesh({1, 1e9, 2, 2, 8}), bad_input, "capsule.length is 1e+09 m");
    EXPECT_ERROR(capsule_mesh({1, 1, 0, 2, 8}), bad_input, "capsule.cap_rings is 0");
    EXPECT_ERROR(capsule_mesh({1, 1, 2, 0, 8}), bad_input, "capsule.bands is 0");
    EXPECT_ERROR(sheet_mesh({1, 1, 1, 8}), bad_input, "sheet.rows is 1");
    EXPECT_ERROR(sheet_mesh({1, nan, 8, 8}), bad_input, "sheet.height is nan m");
    EXPECT_ERROR(blob_mesh({1, 999}), bad_input, "blob.vertices is 999");
    EXPECT_ERROR(blob_mesh({-0.5, 9999}), bad_input, "blob.height is -0.5 m");
    EXPECT_ERROR(tube_mesh({-1, 1, 8, 8}), bad_input, "tube.radius is -1 m");
    EXPECT_ERROR(tube_mesh({1, 0, 8, 8}), bad_input, "tube.length is 0 m");
    EXPECT_ERROR(tube_mesh({1, 1, 1, 8}), bad_input, "tube.rows is 1");
    EXPECT_ERROR(tube_mesh({1, 1, 8, 2}), bad_input, "tube.segments is 2");
    EXPECT_ERROR(tube_mesh({1, 1, 4096, 8192}), bad_input, "tube would have 33554432 vertices");
    EXPECT_ERROR(shirt_mesh({0, 3}), bad_input, "shirt.width is 0 m");
    EXPECT_ERROR(shirt_mesh({1, 0}), bad_input, "shirt.squares is 0");
    EXPECT_ERROR(shirt_mesh({1, 201}), bad_input, "between 1 and 200");
}

}  // namespace
}  // namespace pliant
