// STL, OFF and glTF are read; and no reader crashes, hangs or takes much memory whatever a file holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>

#include "mesh_samples.hpp"
#include "pliant/mesh_generators.hpp"
#include "test_meshes.hpp"

namespace pliant {
namespace {

using test::failure_of;
using test::MeshTest;
using test::tetrahedron;

/// As many vertices and triangles, the same volume: the order of vertices is free.
void expect_like(const SurfaceMesh& mesh, const SurfaceMesh& original)
{
    const MeshReport report = inspect_mesh(mesh), expected = inspect_mesh(original);
    EXPECT_EQ(report.vertices, expected.vertices);
    EXPECT_EQ(report.triangles, expected.triangles);
    EXPECT_EQ(report.euler_characteristic, expected.euler_characteristic);
    EXPECT_TRUE(report.closed && report.oriented);
    EXPECT_NEAR(report.volume, expected.volume, 1e-6 * expected.volume);
    EXPECT_EQ(report.bounds_min, expected.bounds_min);
    EXPECT_EQ(report.bounds_max, expected.bounds_max);
}

TEST_F(MeshTest, every_format_gives_the_same_mesh)
{
    const SurfaceMesh torus = torus_mesh({0.5, 0.2, 24, 12});
    expect_like(mesh_from("a.ply", test::ascii_ply_of(torus)), torus);
    expect_like(mesh_from("a.stl", test::text_stl_of(torus)), torus);
    expect_like(mesh_from("b.STL", test::binary_stl_of(torus)), torus);
    expect_like(mesh_from("a.off", test::off_of(torus)), torus);
    expect_like(mesh_from("a.glb", test::glb_of(torus)), torus);
    file_with("shape.bin", test::gltf_buffer_of(torus));
    expect_like(mesh_from("a.gltf", test::gltf_text_of(torus, R"(,"uri":"shape.bin")")), torus);
    EXPECT_EQ(read_mesh(folder / "a.off").file, folder / "a.off");
}

TEST_F(MeshTest, off_polygons_are_triangulated)
{
    const SurfaceMesh cube =
        mesh_from("cube.off",
                  "OFF # a cube\n8 6 12\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                  "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
    EXPECT_EQ(cube.triangles.size(), 12u);
    EXPECT_NEAR(inspect_mesh(cube).volume, 1, 1e-12);
    EXPECT_TRUE(inspect_mesh(cube).closed);
}

TEST_F(MeshTest, gltf_nodes_place_and_mirror)
{
    const SurfaceMesh shape = tetrahedron();
    file_with("shape.bin", test::gltf_buffer_of(shape));
    const SurfaceMesh mesh = mesh_from(
        "a.gltf", test::gltf_text_of(shape, R"(,"uri":"shape.bin")",
                                     R"([{"mesh":0,"translation":[5,0,0]},{"scale":[2,2,2],"children":[2]},)"
                                     R"({"mesh":0,"scale":[-1,1,1],"translation":[-1,0,0]}])",
                                     "[0,1]"));
    const MeshReport report = inspect_mesh(mesh);
    EXPECT_EQ(report.components, 2u);
    EXPECT_TRUE(report.closed && report.oriented);
    EXPECT_EQ(report.inward_components, 0u);  // the mirrored one as well
    EXPECT_NEAR(report.volume, (1 + 8) / 6.0, 1e-6);
    EXPECT_EQ(report.bounds_min, (Vec3d{-4, 0, 0}));
    EXPECT_EQ(report.bounds_max, (Vec3d{6, 2, 2}));
}

TEST_F(MeshTest, other_formats_say_what_is_wrong)
{
    const std::string binary = test::binary_stl_of(tetrahedron()), text = test::text_stl_of(tetrahedron());
    EXPECT_EQ(read_failure("a.stl", binary.substr(0, 200)),
              "a.stl: it declares 4 triangles, which take 284 bytes, but it has 200; export the mesh again");
    EXPECT_EQ(read_failure("a.stl", binary.substr(0, 60)),
              "a.stl: it has 60 bytes, but a binary STL file begins with 84; export the mesh again");
    std::string endless = binary;
    endless.replace(80, 4, "\xff\xff\xff\xff");
    EXPECT_NE(read_failure("a.stl", endless).find("declares 4294967295 triangles"), std::string::npos);
    std::string infinite = binary;
    infinite.replace(84 + 12, 4, std::string("\0\0\x80\x7f", 4));
    EXPECT_EQ(read_failure("a.stl", infinite),
              "a.stl, byte 96: triangle 0 has the coordinate inf; coordinates must be finite");
    EXPECT_EQ(read_failure("a.stl", text.substr(0, text.size() / 2)),
              "a.stl: it ends without 'endsolid'; export the mesh again");
    std::string word = text;
    word.replace(word.find("vertex 0"), 8, "vertex O");
    EXPECT_EQ(read_failure("a.stl", word), "a.stl, line 4: a vertex has 'O' where a finite number must be");
    word.replace(word.find("      vertex O"), 14, "  corner 1");
    EXPECT_NE(read_failure("a.stl", word).find("unknown word 'corner'"), std::string::npos);
    EXPECT_NE(read_failure("a.stl", "solid nothing\nendsolid nothing\n"), "no failure");
    EXPECT_NE(read_failure("a.stl", "   \n "), "no failure");

    const std::string off = test::off_of(tetrahedron());
    EXPECT_EQ(
        read_failure("a.off", "COFF\n" + off.substr(4)),
        "a.off, line 1: it begins with 'COFF', but must with 'OFF' (without colours, normals or a fourth "
        "coordinate)");
    EXPECT_EQ(
        read_failure("a.off", "OFF\n4000000000 4 0\n0 0 0\n"),
        "a.off, line 2: it declares 4000000000 vertices and 4 faces, more than a file of 25 bytes can hold");
    EXPECT_EQ(read_failure("a.off", off.substr(0, off.size() - 4)),
              "a.off, line 10: face 3 uses vertex '', but there are 4 vertices; correct the index");
    std::string index = off;
    index.replace(index.size() - 2, 1, "9");
    EXPECT_EQ(read_failure("a.off", index),
              "a.off, line 10: face 3 uses vertex '9', but there are 4 vertices; correct the index");
    EXPECT_EQ(read_failure("a.off", "OFF\n1 many 0\n"),
              "a.off, line 2: 'many' is not a count of vertices, faces or edges");
    EXPECT_NE(read_failure("a.off", "OFF\n1 0 0\n0 0 nan\n").find("vertex 0 has 'nan'"), std::string::npos);

    const std::string glb = test::glb_of(tetrahedron());
    for (const std::string& bad : {std::string("{}"), std::string("{"), std::string("no JSON")})
        EXPECT_TRUE(read_failure("a.gltf", bad).starts_with("a.gltf: it cannot be read ("))
            << bad.substr(0, 9);
    EXPECT_EQ(read_failure("a.glb", glb.substr(0, 300)), "a.glb, byte 8: it declares " +
                                                             std::to_string(glb.size()) +
                                                             " bytes, but has 300; export the mesh again");
    EXPECT_EQ(read_failure("a.glb", "{}"),
              "a.glb: it does not begin as a binary glTF file; export the mesh again");
    const auto with_byte = [&](std::size_t at, char value) {
        std::string bytes = glb;
        bytes[at] = value;
        return bytes;
    };
    EXPECT_EQ(read_failure("a.glb", with_byte(4, 1)),
              "a.glb, byte 4: glTF version 1 is unknown; export as version 2");
    EXPECT_NE(read_failure("a.glb", with_byte(15, '\x7f')).find("byte 12: a chunk of 2130"),
              std::string::npos);
    EXPECT_NE(read_failure("a.glb", with_byte(16, 'j')).find("the first chunk is not of type JSON"),
              std::string::npos);
    EXPECT_TRUE(read_failure("a.gltf", test::gltf_text_of(tetrahedron(), R"(,"uri":"none.bin")"))
                    .starts_with("a.gltf: it cannot be read ("));
}

// ---- anything may stand in a file

/// A file with a part cut off, doubled or moved, or some bytes changed.
std::string damaged(std::string bytes, std::mt19937& random)
{
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    switch (below(4)) {
        case 0: return bytes.substr(0, below(bytes.size()));
        case 1: return bytes.erase(below(bytes.size()), 1 + below(20));
        case 2: {
            const std::size_t from = below(bytes.size());
            return bytes.insert(below(bytes.size()), bytes.substr(from, 1 + below(40)));
        }
        default:
            for (std::size_t i = 0; i <= below(8); ++i)
                bytes[below(bytes.size())] =
                    below(2) ? static_cast<char>(random()) : "0123456789-.e \n"[below(15)];
            return bytes;
    }
}

TEST_F(MeshTest, damaged_files_are_read_or_refused)
{
    const SurfaceMesh mesh = icosphere_mesh({1, 2});
    write_mesh(folder / "binary.ply", mesh);
    write_mesh(folder / "mesh.obj", mesh);
    const auto contents = [&](const char* name) {
        std::ifstream file(folder / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    const std::map<std::string, std::string> samples = {
        {"text.ply", test::ascii_ply_of(mesh)}, {"binary.ply", contents("binary.ply")},
        {"mesh.obj", contents("mesh.obj")},     {"text.stl", test::text_stl_of(mesh)},
        {"mesh.glb", test::glb_of(mesh)},       {"binary.stl", test::binary_stl_of(mesh)},
        {"mesh.off", test::off_of(mesh)},
    };
    std::mt19937 random(20221);
    for (const auto& [name, bytes] : samples) {
        int refused = 0;
        constexpr int rounds = 200;
        for (int round = 0; round < rounds; ++round) {
            SCOPED_TRACE(name + ", damage " + std::to_string(round));
            const std::filesystem::path file = file_with(name, damaged(bytes, random));
            try {
                SurfaceMesh read = read_mesh(file);
                inspect_mesh(read);  // throws, and so fails the test, when an index has no vertex
                repair_mesh(read, {.weld_tolerance = 1e-3, .fill_holes = true});
                inspect_mesh(read);
            } catch (const Error& error) {
                ++refused;
                EXPECT_EQ(error.kind, ErrorKind::bad_input);
                EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
            }
        }
        EXPECT_GT(refused, rounds / 10) << name;  // the damage is damage
    }
}

}  // namespace
}  // namespace pliant
