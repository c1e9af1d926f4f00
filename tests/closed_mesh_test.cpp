// Meshes are refused as bodies with volume, with helpful messages, and the files of bad_meshes.py are
// repaired.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "pliant/mesh_generators.hpp"
#include "test_meshes.hpp"
#include "test_paths.hpp"

namespace pliant {
namespace {

namespace fs = std::filesystem;

using test::failure_of;
using test::soup_of;
using test::tetrahedron;
using test::turn_round;

std::string refusal_of(const SurfaceMesh& mesh)
{
    return failure_of([&] { require_closed(mesh, "shape.ply"); });
}

TEST(RequireClosed, says_where_the_hole_is_and_what_to_do)
{
    SurfaceMesh mesh = box_mesh({{2, 2, 2}, 2});
    EXPECT_EQ(refusal_of(mesh), "no failure");
    mesh.triangles.pop_back();
    const std::string message = refusal_of(mesh);
    EXPECT_TRUE(
        message.starts_with("'shape.ply' cannot be a body with volume: it is not closed: 3 edges in 1 "
                            "boundary loop, the longest of 3 edges and 3.41421 m at vertex "))
        << message;
    EXPECT_TRUE(message.ends_with(
        " m; repair it with 'pliant check shape.ply --repair --fill-holes --out FIXED.ply'"))
        << message;
    mesh.file = "folder/shape.ply";
    EXPECT_NE(refusal_of(mesh).find("check folder/shape.ply --repair"), std::string::npos);
}

TEST(RequireClosed, names_the_lightest_repair)
{
    const SurfaceMesh sphere = icosphere_mesh({1, 4});  // its shortest edge is 0.276 m
    EXPECT_NE(refusal_of(soup_of(sphere)).find("--repair --out"), std::string::npos);
    EXPECT_NE(refusal_of(soup_of(sphere, 1e-4f)).find("--repair --weld 0.01 --out"), std::string::npos);
    SurfaceMesh strip = sheet_mesh();
    EXPECT_NE(refusal_of(strip).find("repair it in a modelling program"), std::string::npos);
}

TEST(RequireClosed, refuses_everything_else_that_has_no_volume)
{
    EXPECT_NE(refusal_of({{{0, 0, 0}}, {}}).find("it has no triangles; use a closed mesh"),
              std::string::npos);
    SurfaceMesh mesh = tetrahedron();
    turn_round(mesh);
    EXPECT_NE(
        refusal_of(mesh).find("1 component is inside out (volume of the mesh -0.166667 m^3); repair it with"),
        std::string::npos);
    // Beside a larger one that is not, so that the volume of all is not negative.
    SurfaceMesh two = box_mesh({{2, 2, 2}, 2});
    for (const Triangle& t : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(two.vertices.size());
        two.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    for (const Vec3& x : mesh.vertices) two.vertices.push_back({x.x + 5, x.y, x.z});
    EXPECT_NE(
        refusal_of(two).find("1 component is inside out (volume of the mesh 7.83333 m^3); repair it with"),
        std::string::npos)
        << refusal_of(two);
    std::swap(mesh.triangles[2][0], mesh.triangles[2][1]);
    EXPECT_NE(
        refusal_of(mesh).find("do not agree on the side that is outside, first at an edge of vertex 1 at"),
        std::string::npos);
    mesh = tetrahedron();
    mesh.vertices.push_back({5, 5, 5});
    EXPECT_NE(refusal_of(mesh).find("1 vertex belongs to no triangle; repair it with"), std::string::npos);
    mesh = box_mesh({{1, 1, 1}, 2});
    for (Vec3& v : mesh.vertices) v.z *= 1e-7f;
    EXPECT_NE(refusal_of(mesh).find("encloses no volume"), std::string::npos);
    mesh = tetrahedron();
    mesh.vertices.push_back({0.5f, -1, -1});
    mesh.triangles.push_back({0, 1, 4});
    mesh.triangles.push_back({1, 0, 4});
    EXPECT_NE(refusal_of(mesh).find("1 edge has three or more triangles, first that between vertex 0 at"),
              std::string::npos);
    mesh = tetrahedron();
    for (const Vec3 v : {Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}}) mesh.vertices.push_back(v);
    for (const Triangle t : {Triangle{0, 4, 5}, {0, 6, 4}, {4, 6, 5}, {0, 5, 6}}) mesh.triangles.push_back(t);
    EXPECT_NE(refusal_of(mesh).find("parts of it touch in 1 vertex, first vertex 0 at (0, 0, 0) m"),
              std::string::npos);
    mesh = tetrahedron();
    mesh.vertices.push_back(mesh.vertices[3]);  // an edge of no length: 3-4
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 4}, {0, 3, 4}, {3, 2, 4}};
    ASSERT_TRUE(inspect_mesh(mesh).closed);
    EXPECT_NE(refusal_of(mesh).find("it has an edge without length; repair it with"), std::string::npos);
}

// ---- the files of bad_meshes.py

TEST(BadMeshes, repair_makes_of_bad_files_what_the_manifest_says)
{
    const fs::path bad = test::bad_meshes_folder;
    const auto manifest = nlohmann::json::parse(std::ifstream(bad / "manifest.json"));
    std::size_t bodies = 0, mended_bodies = 0;
    for (const auto& entry : manifest.at("files")) {
        const std::string name = entry.at("file"), parse = entry.at("parse");
        if (parse == "error") continue;
        SCOPED_TRACE(name + ": " + entry.at("what").get<std::string>());
        SurfaceMesh mesh;
        try {
            mesh = read_mesh(bad / name);
        } catch (const Error& error) {
            EXPECT_EQ(parse, "ok_or_error") << error.what();
            continue;
        }
        const bool is_body = failure_of([&] { require_closed(mesh, name); }) == "no failure";
        if (!entry.value("closed", true) || entry.value("volume_sign", 1) < 1) {
            EXPECT_FALSE(is_body);
        } else if (entry.value("valid", false)) {
            EXPECT_TRUE(is_body);
        }
        bodies += is_body;

        const MeshReport before = inspect_mesh(mesh);
        repair_mesh(mesh, {.weld_tolerance = entry.value("weld_tolerance", 0.0)});
        const MeshReport after = inspect_mesh(mesh);
        mended_bodies += failure_of([&] { require_closed(mesh, name); }) == "no failure";
        EXPECT_EQ(after.vertices, entry.value("weld_to", after.vertices));
        const bool can_close = before.closed || entry.contains("weld_to") || before.duplicate_triangles > 0 ||
                               entry.value("closed_after_dropping", false);
        EXPECT_EQ(after.closed, can_close);
        EXPECT_EQ(after.inward_components, 0u);
        EXPECT_EQ(after.oriented, before.triangles > 0 && name != "moebius.ply");
        EXPECT_EQ(after.isolated_vertices, after.triangles > 0 ? 0 : after.vertices);
        if (before.closed && before.oriented) {
            EXPECT_NEAR(after.volume, std::abs(before.volume), 1e-6 * std::abs(before.volume));
        }
    }
    EXPECT_GE(bodies, 25u);
    EXPECT_GE(mended_bodies,
              bodies + 8);  // soup, jitter, inside out, mixed, duplicate, degenerate, unused, length 0
}

TEST(BadMeshes, the_scan_is_closed)
{
    SurfaceMesh mesh = read_mesh(fs::path(test::bad_meshes_folder) / "scan_with_holes.ply");
    ASSERT_EQ(inspect_mesh(mesh).boundary_loops, 5u);
    const RepairReport report = repair_mesh(mesh, {.fill_holes = true});
    EXPECT_EQ(report.isolated_vertices, 1113u);
    EXPECT_EQ(report.filled_holes, 5u);
    EXPECT_EQ(report.added_triangles, 223u - 2 * 5);  // n corners take n - 2 triangles
    EXPECT_NO_THROW(require_closed(mesh, "scan"));
    EXPECT_EQ(inspect_mesh(mesh).genus, 0);
}

}  // namespace
}  // namespace pliant
