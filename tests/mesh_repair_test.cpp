// Meshes are repaired.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "pliant/mesh_generators.hpp"
#include "test_meshes.hpp"

namespace pliant {
namespace {

using test::failure_of;
using test::soup_of;
using test::tetrahedron;
using test::turn_round;

void append(SurfaceMesh& mesh, const SurfaceMesh& other, Vec3 offset = {})
{
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3 v : other.vertices)
        mesh.vertices.push_back({v.x + offset.x, v.y + offset.y, v.z + offset.z});
    for (const Triangle& t : other.triangles)
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

void expect_good(const SurfaceMesh& mesh)
{
    EXPECT_NO_THROW(require_closed(mesh, "mesh"));
    const MeshReport report = inspect_mesh(mesh);
    EXPECT_EQ(report.degenerate_triangles + report.duplicate_triangles + report.coincident_vertices, 0u);
}

// ---- repair

TEST(MeshRepair, a_good_mesh_stays_as_it_is)
{
    for (const SurfaceMesh& good : {tetrahedron(), torus_mesh(), blob_mesh({1, 1500}), box_mesh()}) {
        SurfaceMesh mesh = good;
        const RepairReport report = repair_mesh(mesh, {.fill_holes = true});
        EXPECT_EQ(describe(report), "");
        EXPECT_EQ(mesh.vertices, good.vertices);
        EXPECT_EQ(mesh.triangles, good.triangles);
    }
}

TEST(MeshRepair, a_soup_is_welded)
{
    const SurfaceMesh torus = torus_mesh({0.5, 0.2, 40, 20});
    SurfaceMesh mesh = soup_of(torus);
    EXPECT_EQ(repair_mesh(mesh).welded_vertices, 4800u - 800u);
    expect_good(mesh);
    EXPECT_EQ(inspect_mesh(mesh).vertices, 800u);
    EXPECT_DOUBLE_EQ(inspect_mesh(mesh).volume, inspect_mesh(torus).volume);

    SurfaceMesh jittered = soup_of(torus, 1e-6f);
    const SurfaceMesh as_read = jittered;
    EXPECT_EQ(repair_mesh(jittered).open_loops, 1600u);
    jittered = as_read;
    EXPECT_EQ(repair_mesh(jittered, {.weld_tolerance = 1e-5}).welded_vertices, 4800u - 800u);
    expect_good(jittered);
    // Each vertex is off by sqrt(3) 1e-6 m at most, the volume by that times the area of 3.9 m^2.
    EXPECT_NEAR(inspect_mesh(jittered).volume, inspect_mesh(torus).volume, 1.8e-6 * 4);
}

TEST(MeshRepair, welding_is_by_distance_not_by_cell)
{
    // Pairs astride of every border of a cell of the grid, and far from 0.
    SurfaceMesh mesh;
    const float step = 1.0f / 64, gap = step / 4;
    for (int i = -8; i < 8; ++i)
        for (const float side : {-gap, gap}) {
            const float x = 100 + static_cast<float>(i) * step + side;
            mesh.vertices.push_back({x, 0, 0});
            mesh.vertices.push_back({x, 1, 0});
            mesh.vertices.push_back({x, 0, 1});
            const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
            mesh.triangles.push_back({n - 3, n - 2, n - 1});
        }
    EXPECT_EQ(repair_mesh(mesh, {.weld_tolerance = 2.01 * double(gap) * 0.9}).welded_vertices, 0u);
    EXPECT_EQ(repair_mesh(mesh, {.weld_tolerance = 2.01 * double(gap)}).welded_vertices, 16u * 3);
}

TEST(MeshRepair, degenerate_duplicate_and_unused_are_dropped)
{
    SurfaceMesh mesh = icosphere_mesh({1, 4});
    const SurfaceMesh good = mesh;
    mesh.triangles.push_back({0, 0, 1});
    mesh.triangles.push_back({3, 3, 3});
    const Triangle t = mesh.triangles[5];
    mesh.triangles.push_back({t[1], t[2], t[0]});
    mesh.triangles.push_back({t[1], t[0], t[2]});
    mesh.vertices.push_back({9, 9, 9});
    const RepairReport report = repair_mesh(mesh);
    EXPECT_EQ(report.dropped_triangles, 2u);
    EXPECT_EQ(report.duplicate_triangles, 2u);
    EXPECT_EQ(report.isolated_vertices, 1u);
    EXPECT_EQ(mesh.vertices, good.vertices);
    EXPECT_EQ(mesh.triangles, good.triangles);
}

TEST(MeshRepair, a_triangle_without_area_ends_without_a_hole)
{
    // The edge 0-1 of the tetrahedron gets a vertex in its middle, on one side only; a triangle without area
    // closes the gap.
    SurfaceMesh mesh = tetrahedron();
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back({0.5f, 0, 0});
    mesh.triangles = {{0, 2, 1}, {0, middle, 3}, {middle, 1, 3}, {0, 1, middle}, {1, 2, 3}, {2, 0, 3}};
    ASSERT_TRUE(inspect_mesh(mesh).closed);
    EXPECT_EQ(inspect_mesh(mesh).degenerate_triangles, 1u);
    EXPECT_EQ(repair_mesh(mesh).flipped_edges, 1u);
    expect_good(mesh);
    EXPECT_DOUBLE_EQ(inspect_mesh(mesh).volume, 1.0 / 6);
}

TEST(MeshRepair, orientation_is_made_consistent_and_outward)
{
    SurfaceMesh mesh = icosphere_mesh({1, 6});
    const double volume = inspect_mesh(mesh).volume;
    std::mt19937 random(3);
    for (Triangle& triangle : mesh.triangles)
        if (random() % 2 == 0) std::swap(triangle[1], triangle[2]);
    EXPECT_FALSE(inspect_mesh(mesh).oriented);
    EXPECT_TRUE(inspect_mesh(mesh).orientable);
    EXPECT_GT(repair_mesh(mesh).turned_triangles, 200u);
    expect_good(mesh);
    EXPECT_DOUBLE_EQ(inspect_mesh(mesh).volume, volume);
    turn_round(mesh);
    EXPECT_EQ(inspect_mesh(mesh).inward_components, 1u);
    EXPECT_EQ(repair_mesh(mesh).turned_triangles, mesh.triangles.size());
    EXPECT_DOUBLE_EQ(inspect_mesh(mesh).volume, volume);
}

TEST(MeshRepair, a_cavity_faces_inward_and_what_is_in_it_outward)
{
    const auto ball = [](double radius, bool inward) {
        SurfaceMesh mesh = icosphere_mesh({radius, 5});
        if (inward) turn_round(mesh);
        return mesh;
    };
    const double unit = inspect_mesh(ball(1, false)).volume;
    SurfaceMesh right = ball(1, false);
    append(right, ball(0.5, true));
    append(right, ball(0.25, false));
    append(right, ball(0.5, false), {3, 0, 0});
    const double volume = inspect_mesh(right).volume;
    EXPECT_NEAR(volume, unit * (1 - 1.0 / 8 + 1.0 / 64 + 1.0 / 8), 1e-6);
    EXPECT_EQ(inspect_mesh(right).inward_components, 0u);
    EXPECT_EQ(inspect_mesh(right).components, 4u);
    EXPECT_EQ(inspect_mesh(right).genus, 0);
    SurfaceMesh same = right;
    EXPECT_EQ(describe(repair_mesh(same)), "");

    SurfaceMesh wrong = ball(1, true);
    append(wrong, ball(0.5, false));
    append(wrong, ball(0.25, true));
    append(wrong, ball(0.5, true), {3, 0, 0});
    EXPECT_EQ(inspect_mesh(wrong).inward_components, 4u);
    repair_mesh(wrong);
    EXPECT_NEAR(inspect_mesh(wrong).volume, volume,
                1e-12 * volume);  // 1,500 terms summed about another point
    expect_good(wrong);

    SurfaceMesh overlapping = ball(1, false);  // neither is in the other
    append(overlapping, ball(0.5, false), {0.8f, 0, 0});
    EXPECT_EQ(describe(repair_mesh(overlapping)), "");
}

TEST(MeshRepair, a_hole_gets_the_triangles_of_least_area)
{
    // A tetrahedron of which two faces are there: the hole is a skew quadrilateral. One of its diagonals is
    // the edge between those faces, and shorter than the other: yet it may not be taken.
    const std::vector<Vec3> corners = {{0, 0, 0.3f}, {1, 0, 0}, {0, 0, -0.3f}, {-1, 0.5f, 0}};
    SurfaceMesh half{corners, {{0, 1, 2}, {0, 2, 3}}};
    EXPECT_EQ(repair_mesh(half, {.fill_holes = true}).open_loops, 0u);
    EXPECT_EQ(half.triangles.size(), 4u);
    EXPECT_TRUE(inspect_mesh(half).closed);

    // A box without its lid, of which one corner is raised: the lid has less area across that corner.
    for (const std::size_t raised : {4u, 5u, 6u, 7u}) {
        SurfaceMesh box{
            {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}},
            {{0, 1, 2},
             {0, 2, 3},
             {0, 4, 5},
             {0, 5, 1},
             {1, 5, 6},
             {1, 6, 2},
             {2, 6, 7},
             {2, 7, 3},
             {3, 7, 4},
             {3, 4, 0}}};
        box.vertices[raised].y = 1.6f;
        EXPECT_EQ(repair_mesh(box, {.fill_holes = true}).open_loops, 0u);
        const auto area_of = [&](std::size_t a, std::size_t b, std::size_t c) {
            const Vec3d x = to_double(box.vertices[a]);
            const Vec3d n = cross(to_double(box.vertices[b]) - x, to_double(box.vertices[c]) - x);
            return std::sqrt(dot(n, n)) / 2;
        };
        double lid = 0;
        for (const Triangle& t : box.triangles)
            if (t[0] > 3 && t[1] > 3 && t[2] > 3) lid += area_of(t[0], t[1], t[2]);
        EXPECT_NEAR(lid, std::min(area_of(4, 5, 6) + area_of(4, 6, 7), area_of(4, 5, 7) + area_of(5, 6, 7)),
                    1e-6)
            << raised;
    }
}

TEST(MeshRepair, a_cut_sphere_is_closed)
{
    for (const std::size_t removed : {1u, 2u, 5u, 40u}) {
        SCOPED_TRACE(removed);
        SurfaceMesh mesh = icosphere_mesh({1, 8});
        const MeshReport before = inspect_mesh(mesh);
        mesh.triangles.erase(mesh.triangles.begin() + 100,
                             mesh.triangles.begin() + 100 + static_cast<std::ptrdiff_t>(removed));
        turn_round(mesh);
        EXPECT_GE(repair_mesh(mesh).open_loops, 1u);  // not asked to fill
        const RepairReport report = repair_mesh(mesh, {.fill_holes = true});
        EXPECT_GE(report.filled_holes, 1u);
        EXPECT_EQ(report.added_vertices, 0u);
        EXPECT_EQ(report.open_loops, 0u);
        EXPECT_EQ(report.turned_triangles, mesh.triangles.size() - report.added_triangles);
        expect_good(mesh);
        const MeshReport after = inspect_mesh(mesh);
        EXPECT_EQ(after.euler_characteristic, 2);
        // The cap cut off at the hole: its area times its height, both below those of the removed triangles,
        // each of less than 0.025 m^2 and a chord height of less than 0.1 m each way across at most 40 of
        // them.
        EXPECT_NEAR(after.volume, before.volume, 0.025 * static_cast<double>(removed) * 0.2);
        EXPECT_LE(after.volume, before.volume * (1 + 1e-9));
    }
}

TEST(MeshRepair, a_flat_hole_with_straight_rims_gets_triangles_with_area)
{
    SurfaceMesh mesh = box_mesh({{1, 1, 1}, 6});
    std::erase_if(mesh.triangles, [&](const Triangle& t) {  // the whole side y = 1/2
        return mesh.vertices[t[0]].y == 0.5f && mesh.vertices[t[1]].y == 0.5f &&
               mesh.vertices[t[2]].y == 0.5f;
    });
    const RepairReport report = repair_mesh(mesh, {.fill_holes = true});
    EXPECT_EQ(report.isolated_vertices, 25u);
    EXPECT_EQ(report.filled_holes, 1u);
    EXPECT_EQ(report.added_triangles, 22u);  // 24 corners
    expect_good(mesh);
    EXPECT_NEAR(inspect_mesh(mesh).volume, 1, 1e-6);
    EXPECT_NEAR(inspect_mesh(mesh).area, 6, 1e-6);
}

TEST(MeshRepair, a_long_loop_gets_a_fan)
{
    SurfaceMesh mesh = capsule_mesh({0.25, 0.5, 4, 4, 500});
    std::erase_if(mesh.triangles, [](const Triangle& t) { return t[0] == 0 || t[1] == 0 || t[2] == 0; });
    const RepairReport report = repair_mesh(mesh, {.fill_holes = true});
    EXPECT_EQ(report.added_vertices, 1u);
    EXPECT_EQ(report.added_triangles, 500u);
    EXPECT_TRUE(inspect_mesh(mesh).closed && inspect_mesh(mesh).oriented);
    EXPECT_NO_THROW(require_closed(mesh, "capsule"));
}

TEST(MeshRepair, a_hole_that_touches_itself_is_two)
{
    // Two removed triangles that meet in one vertex only.
    SurfaceMesh mesh = icosphere_mesh({1, 4});
    const std::uint32_t shared = mesh.triangles[20][0];
    std::vector<std::size_t> around;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t vertex : mesh.triangles[t])
            if (vertex == shared) around.push_back(t);
    const auto common = [&](std::size_t a, std::size_t b) {
        int count = 0;
        for (const std::uint32_t u : mesh.triangles[a])
            for (const std::uint32_t v : mesh.triangles[b]) count += u == v;
        return count;
    };
    std::size_t other = 0;
    for (const std::size_t t : around)
        if (common(around[0], t) == 1) other = t;
    ASSERT_NE(other, 0u);
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(std::max(other, around[0])));
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(std::min(other, around[0])));
    EXPECT_EQ(repair_mesh(mesh, {.fill_holes = true}).filled_holes, 2u);
    expect_good(mesh);
}

TEST(MeshRepair, what_would_open_a_closed_mesh_is_not_done)
{
    SurfaceMesh pillow{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
    EXPECT_EQ(describe(repair_mesh(pillow)), "");
    SurfaceMesh touching = tetrahedron();  // welding would make one vertex with two fans
    for (const Vec3 v : {Vec3{0, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}})
        touching.vertices.push_back(v);
    for (const Triangle t : {Triangle{4, 5, 6}, {4, 7, 5}, {5, 7, 6}, {4, 6, 7}})
        touching.triangles.push_back(t);
    ASSERT_TRUE(inspect_mesh(touching).closed);
    EXPECT_EQ(repair_mesh(touching).welded_vertices, 0u);
    EXPECT_TRUE(inspect_mesh(touching).closed);
}

TEST(MeshRepair, bad_tolerances_are_refused)
{
    SurfaceMesh mesh = tetrahedron();
    for (const double tolerance : {-1.0, 1e5, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_NE(failure_of([&] { repair_mesh(mesh, {.weld_tolerance = tolerance}); }).find("between 0 and"),
                  std::string::npos);
    mesh.triangles[0][0] = 7;
    EXPECT_NE(failure_of([&] { repair_mesh(mesh); }).find("vertex 7"), std::string::npos);
    SurfaceMesh nothing;
    EXPECT_EQ(describe(repair_mesh(nothing, {.fill_holes = true})), "");
}

}  // namespace
}  // namespace pliant
