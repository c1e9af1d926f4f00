// Meshes are inspected, those in code and the files of bad_meshes.py, which the build writes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "mesh/disc.hpp"
#include "pliant/mesh_generators.hpp"
#include "test_meshes.hpp"
#include "test_paths.hpp"

namespace pliant {
namespace {

namespace fs = std::filesystem;

using test::tetrahedron;

/// n x n vertices over the unit square.
SurfaceMesh sheet(std::uint32_t n)
{
    SurfaceMesh mesh;
    for (std::uint32_t row = 0; row < n; ++row)
        for (std::uint32_t column = 0; column < n; ++column)
            mesh.vertices.push_back({static_cast<float>(column) / static_cast<float>(n - 1), 0,
                                     static_cast<float>(row) / static_cast<float>(n - 1)});
    for (std::uint32_t row = 0; row + 1 < n; ++row)
        for (std::uint32_t column = 0; column + 1 < n; ++column) {
            const std::uint32_t i = row * n + column;
            mesh.triangles.push_back({i, i + n, i + 1});
            mesh.triangles.push_back({i + 1, i + n, i + n + 1});
        }
    return mesh;
}

SurfaceMesh moebius_strip(std::uint32_t n)
{
    SurfaceMesh mesh;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double turn = 2 * std::numbers::pi * i / n;
        for (const double side : {-0.3, 0.3}) {
            const double radius = 1 + side * std::cos(turn / 2);
            mesh.vertices.push_back(
                to_float({radius * std::cos(turn), radius * std::sin(turn), side * std::sin(turn / 2)}));
        }
        const std::uint32_t a = 2 * i, b = 2 * i + 1;
        const std::uint32_t c = i + 1 < n ? 2 * i + 2 : 1, d = i + 1 < n ? 2 * i + 3 : 0;
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({b, c, d});
    }
    return mesh;
}

// ---- inspection

TEST(MeshInspection, tetrahedron_is_closed)
{
    const MeshReport report = inspect_mesh(tetrahedron());
    EXPECT_EQ(report.edges, 6u);
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.euler_characteristic, 2);
    EXPECT_TRUE(report.closed);
    EXPECT_TRUE(report.oriented);
    EXPECT_DOUBLE_EQ(report.volume, 1.0 / 6);
    EXPECT_DOUBLE_EQ(report.area, 1.5 + std::sqrt(3.0) / 2);
    EXPECT_DOUBLE_EQ(report.edge_min, 1);
    EXPECT_DOUBLE_EQ(report.edge_max, std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(report.edge_mean, (1 + std::sqrt(2.0)) / 2);
    EXPECT_EQ(report.bounds_max, (Vec3d{1, 1, 1}));
    EXPECT_EQ(describe(report),
              "4 vertices, 6 edges, 4 triangles in 1 component\n"
              "surface: closed, consistently oriented outward, Euler characteristic 2, genus 0\n"
              "area: 2.36603 m^2\n"
              "volume: 0.166667 m^3\n"
              "edge length: 1 to 1.41421 m, mean 1.20711 m\n"
              "bounds: (0, 0, 0) to (1, 1, 1) m\n");
}

TEST(MeshInspection, open_sheet_has_one_boundary_loop)
{
    const MeshReport report = inspect_mesh(sheet(5));
    EXPECT_EQ(report.triangles, 32u);
    EXPECT_EQ(report.boundary_edges, 16u);
    EXPECT_EQ(report.boundary_loops, 1u);
    EXPECT_EQ(report.euler_characteristic, 1);
    EXPECT_FALSE(report.closed);
    EXPECT_TRUE(report.oriented);
    EXPECT_NEAR(report.area, 1, 1e-12);
    EXPECT_EQ(report.non_manifold_vertices, 0u);
}

TEST(MeshInspection, hole_is_a_second_loop)
{
    SurfaceMesh mesh = sheet(5);
    mesh.triangles.erase(mesh.triangles.begin() + 2 * 5, mesh.triangles.begin() + 2 * 6);  // the cell (1, 1)
    const MeshReport report = inspect_mesh(mesh);
    EXPECT_EQ(report.boundary_edges, 20u);
    EXPECT_EQ(report.boundary_loops, 2u);
    EXPECT_EQ(report.euler_characteristic, 0);
}

TEST(Disc, is_an_irregular_mesh_without_faults)
{
    for (const std::uint32_t rings : {1u, 2u, 3u, 7u, 32u, 100u}) {
        SCOPED_TRACE(rings);
        const SurfaceMesh disc = make_disc(0.8, rings);
        ASSERT_EQ(disc.vertices.size(), 1 + 3u * rings * (rings + 1));
        ASSERT_EQ(disc.vertices.size(), disc_node_count(rings));
        const MeshReport report = inspect_mesh(disc);
        EXPECT_EQ(report.triangles, 6u * rings * rings);
        EXPECT_EQ(report.components, 1u);
        EXPECT_EQ(report.euler_characteristic, 1);
        EXPECT_TRUE(report.oriented);
        EXPECT_EQ(report.boundary_edges, 6u * rings);
        EXPECT_EQ(report.boundary_loops, 1u);
        EXPECT_EQ(report.isolated_vertices + report.non_manifold_edges + report.non_manifold_vertices +
                      report.degenerate_triangles + report.duplicate_triangles + report.coincident_vertices,
                  0u);
        const double hem = 6.0 * rings, angle = 2 * std::numbers::pi / hem;  // the hem is a regular polygon
        EXPECT_NEAR(report.area, 0.5 * hem * 0.8 * 0.8 * std::sin(angle), 1e-5);
        EXPECT_GT(report.edge_min, 0.5 * 0.8 / rings);
        EXPECT_LT(report.edge_max, 1.9 * 0.8 / rings);
        if (rings > 1) {
            EXPECT_GT(report.edge_max, 1.1 * report.edge_min);  // irregular
        }
    }
}

TEST(Disc, faces_up_everywhere)
{
    const SurfaceMesh disc = make_disc(1, 40);
    for (const Triangle& t : disc.triangles) {
        const Vec3d a = to_double(disc.vertices[t[0]]), b = to_double(disc.vertices[t[1]]),
                    c = to_double(disc.vertices[t[2]]);
        EXPECT_GT(cross(b - a, c - a).y, 0.2 / (40.0 * 40.0)) << t[0] << " " << t[1] << " " << t[2];
    }
}

TEST(Disc, is_the_same_every_time)
{
    const SurfaceMesh first = make_disc(0.5, 9), second = make_disc(0.5, 9);
    EXPECT_EQ(first.vertices, second.vertices);
    EXPECT_EQ(first.triangles, second.triangles);
}

TEST(MeshInspection, moebius_strip_cannot_be_oriented)
{
    const MeshReport report = inspect_mesh(moebius_strip(24));
    EXPECT_FALSE(report.oriented);
    EXPECT_FALSE(report.orientable);
    EXPECT_FALSE(report.closed);
    EXPECT_EQ(report.boundary_edges, 48u);
    EXPECT_EQ(report.boundary_loops, 1u);
    EXPECT_EQ(report.euler_characteristic, 0);
    EXPECT_EQ(report.non_manifold_edges + report.non_manifold_vertices, 0u);
}

TEST(MeshInspection, genus_is_the_number_of_handles)
{
    SurfaceMesh mesh = torus_mesh({0.5, 0.2, 12, 8});
    EXPECT_EQ(inspect_mesh(mesh).genus, 1);
    const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
    const SurfaceMesh one = mesh, ball = icosphere_mesh({0.1, 2});
    for (const Vec3 v : one.vertices) mesh.vertices.push_back({v.x + 3, v.y, v.z});
    for (const Triangle& t : one.triangles)
        mesh.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
    for (const Vec3 v : ball.vertices) mesh.vertices.push_back(v);
    for (const Triangle& t : ball.triangles)
        mesh.triangles.push_back({t[0] + 2 * count, t[1] + 2 * count, t[2] + 2 * count});
    const MeshReport report = inspect_mesh(mesh);
    EXPECT_EQ(report.components, 3u);
    EXPECT_EQ(report.euler_characteristic, 2);
    EXPECT_EQ(report.genus, 2);
    EXPECT_EQ(report.inward_components, 0u);
}

TEST(MeshInspection, loops_have_a_place_and_a_length)
{
    SurfaceMesh mesh = box_mesh({{2, 2, 2}, 4});
    // Two neighbouring triangles, of a square 0.5 m wide, and one elsewhere.
    const Triangle far = mesh.triangles.back();
    mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 2);
    mesh.triangles.pop_back();
    const MeshReport report = inspect_mesh(mesh);
    ASSERT_EQ(report.loops.size(), 2u);
    EXPECT_EQ(report.boundary_loops, 2u);
    EXPECT_EQ(report.loops[0].edges, 4u);
    EXPECT_DOUBLE_EQ(report.loops[0].length, 2);
    EXPECT_EQ(report.loops[0].vertex, 0u);
    EXPECT_EQ(report.loops[0].position, to_double(mesh.vertices[0]));
    EXPECT_EQ(report.loops[1].edges, 3u);
    EXPECT_DOUBLE_EQ(report.loops[1].length, 1 + std::sqrt(0.5));
    EXPECT_EQ(report.loops[1].vertex, std::min({far[0], far[1], far[2]}));
    EXPECT_NE(describe(report).find("2 boundary loops\n  of 4 edges, 2 m long, at vertex 0 (-1, -1, -1) m\n"),
              std::string::npos)
        << describe(report);
}

TEST(MeshInspection, inside_out_volume_is_negative)
{
    SurfaceMesh mesh = tetrahedron();
    for (Triangle& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
    const MeshReport report = inspect_mesh(mesh);
    EXPECT_TRUE(report.closed && report.oriented);
    EXPECT_DOUBLE_EQ(report.volume, -1.0 / 6);
    EXPECT_NE(describe(report).find("inside out"), std::string::npos);
}

TEST(MeshInspection, fin_makes_an_edge_non_manifold)
{
    SurfaceMesh mesh = tetrahedron();
    mesh.vertices.push_back({0.5f, -1, -1});
    mesh.triangles.push_back({0, 1, 4});
    const MeshReport report = inspect_mesh(mesh);
    EXPECT_EQ(report.non_manifold_edges, 1u);
    EXPECT_EQ(report.non_manifold_vertices, 0u);
    EXPECT_EQ(report.boundary_edges, 2u);
    EXPECT_FALSE(report.closed);
}

TEST(MeshInspection, two_solids_at_one_vertex_are_two_fans)
{
    SurfaceMesh mesh = tetrahedron();
    for (const Vec3 v : {Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}}) mesh.vertices.push_back(v);
    for (const Triangle t : {Triangle{0, 4, 5}, {0, 6, 4}, {4, 6, 5}, {0, 5, 6}}) mesh.triangles.push_back(t);
    const MeshReport report = inspect_mesh(mesh);
    EXPECT_EQ(report.non_manifold_vertices, 1u);
    EXPECT_EQ(report.boundary_edges + report.non_manifold_edges, 0u);
    EXPECT_EQ(report.components, 1u);
    EXPECT_FALSE(report.closed);
    EXPECT_NE(describe(report).find("1 non-manifold vertex (more than one fan), first vertex 0\n"),
              std::string::npos);
}

TEST(MeshInspection, degenerate_duplicate_isolated_coincident)
{
    SurfaceMesh mesh = tetrahedron();
    mesh.triangles.push_back({2, 1, 0});  // a duplicate, turned and shifted
    mesh.triangles.push_back({0, 0, 1});  // a vertex twice
    mesh.vertices.insert(mesh.vertices.end(), {{-0.0f, 0, 0}, {0.5f, 0, 0}, {7, 7, 7}});
    mesh.triangles.push_back({0, 1, 5});  // no area
    const MeshReport report = inspect_mesh(mesh);
    EXPECT_EQ(report.duplicate_triangles, 1u);
    EXPECT_EQ(report.degenerate_triangles, 2u);
    EXPECT_EQ(report.coincident_vertices, 1u);
    EXPECT_EQ(report.isolated_vertices, 2u);
    EXPECT_FALSE(report.closed);
}

TEST(MeshInspection, meshes_of_almost_nothing)
{
    EXPECT_EQ(describe(inspect_mesh({})),
              "0 vertices, 0 edges, 0 triangles in 0 components\nbounds: (0, 0, 0) to (0, 0, 0) m\n");
    const MeshReport points = inspect_mesh({{{0, 0, 0}, {1, 2, 3}}, {}});
    EXPECT_FALSE(points.closed || points.oriented);
    EXPECT_EQ(points.isolated_vertices, 2u);
    const MeshReport dot = inspect_mesh({{{1, 1, 1}}, {{0, 0, 0}}});
    EXPECT_EQ(dot.edges, 0u);
    EXPECT_EQ(dot.degenerate_triangles, 1u);
    const MeshReport pillow = inspect_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}});
    EXPECT_TRUE(pillow.closed && pillow.oriented);
    EXPECT_EQ(pillow.volume, 0);
}

// ---- the files of bad_meshes.py

TEST(BadMeshes, bad_files_are_refused_and_odd_ones_read)
{
    const fs::path bad = test::bad_meshes_folder;
    const auto manifest = nlohmann::json::parse(std::ifstream(bad / "manifest.json"));
    std::size_t checked = 0, read = 0;
    for (const auto& entry : manifest.at("files")) {
        const std::string name = entry.at("file"), parse = entry.at("parse");
        SCOPED_TRACE(name + ": " + entry.at("what").get<std::string>());
        const std::clock_t begin = std::clock();
        try {
            const SurfaceMesh mesh = read_mesh(bad / name);
            EXPECT_NE(parse, "error");
            const MeshReport report = inspect_mesh(mesh);
            const int volume_sign = (report.volume > 0) - (report.volume < 0);
            const bool valid = report.oriented && report.volume > 0;
            EXPECT_EQ(report.vertices, entry.value("V", report.vertices));
            EXPECT_EQ(report.triangles, entry.value("triangles", entry.value("F", report.triangles)));
            EXPECT_EQ(report.closed, entry.value("closed", report.closed));
            EXPECT_EQ(report.components, entry.value("components", report.components));
            EXPECT_NEAR(report.volume, entry.value("volume", report.volume), 1e-6);
            EXPECT_EQ(volume_sign, entry.value("volume_sign", volume_sign));
            EXPECT_EQ(valid, entry.value("valid", valid));
            ++read;
        } catch (const Error& error) {
            EXPECT_NE(parse, "ok") << error.what();
            EXPECT_EQ(error.kind, ErrorKind::bad_input);
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
            EXPECT_LT(std::string(error.what()).size(), 300 + bad.string().size());
        }
        EXPECT_LT(std::clock() - begin, 10 * CLOCKS_PER_SEC);  // of the processor
        ++checked;
    }
    EXPECT_GE(checked, 103u);
    EXPECT_GE(read, 48u);
}

TEST(BadMeshes, measures_of_scans_agree_with_those_of_python)
{
    const fs::path bad = test::bad_meshes_folder;
    const auto manifest = nlohmann::json::parse(std::ifstream(bad / "manifest.json"));
    std::size_t scans = 0;
    for (const auto& entry : manifest.at("files")) {
        if (!entry.contains("area")) continue;
        const std::string name = entry.at("file");
        SCOPED_TRACE(name);
        const MeshReport report = inspect_mesh(read_mesh(bad / name));
        EXPECT_EQ(report.edges, entry.at("edges"));
        EXPECT_EQ(report.boundary_edges, entry.at("boundary_edges"));
        EXPECT_EQ(report.boundary_loops, entry.at("loops"));
        EXPECT_EQ(report.isolated_vertices, entry.at("unused"));
        EXPECT_EQ(report.non_manifold_edges + report.non_manifold_vertices + report.duplicate_triangles, 0u);
        const double area = entry.at("area"), volume = entry.value("volume", report.volume),
                     edge_mean = entry.value("edge_mean", report.edge_mean);
        EXPECT_NEAR(report.area, area, 1e-9 * area);
        EXPECT_NEAR(report.volume, volume, 1e-9 * volume);
        EXPECT_NEAR(report.edge_mean, edge_mean, 1e-9 * edge_mean);
        EXPECT_TRUE(report.oriented);
        ++scans;
    }
    EXPECT_EQ(scans, 2u);
}

}  // namespace
}  // namespace pliant
