// Files of meshes: round trips, what stands in them, and files that cannot be read or written.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "files/atomic_file.hpp"
#include "test_meshes.hpp"

namespace pliant {
namespace {

namespace fs = std::filesystem;

using test::failure_of;
using test::MeshTest;
using test::tetrahedron;

// ---- round trips

TEST_F(MeshTest, round_trip_keeps_every_bit)
{
    SurfaceMesh mesh = tetrahedron();
    mesh.vertices[0] = {-0.0f, 0.1f, 1.0f / 3.0f};
    mesh.vertices[1] = {std::numeric_limits<float>::max(), std::numeric_limits<float>::denorm_min(), -1e-40f};
    mesh.vertices[2] = {16777217.0f, 1e-7f, std::nextafter(1.0f, 2.0f)};
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-1000, 1000);
    for (int i = 0; i < 1000; ++i)
        mesh.vertices.push_back({uniform(random), uniform(random), uniform(random)});
    for (const char* name : {"mesh.ply", "mesh.obj", "MESH.PLY"}) {
        write_mesh(folder / name, mesh);
        const SurfaceMesh again = read_mesh(folder / name);
        EXPECT_EQ(again.triangles, mesh.triangles) << name;
        ASSERT_EQ(again.vertices, mesh.vertices) << name;
        EXPECT_TRUE(std::signbit(again.vertices[0].x)) << name;
    }
}

TEST_F(MeshTest, written_files_look_as_documented)
{
    const SurfaceMesh mesh{{{0, 0.5f, -1}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    write_mesh(folder / "mesh.obj", mesh);
    std::stringstream text;
    text << std::ifstream(folder / "mesh.obj").rdbuf();
    EXPECT_EQ(text.str(), "# Pliant, positions in m\nv 0 0.5 -1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_mesh(folder / "mesh.ply", mesh);
    std::stringstream binary;
    binary << std::ifstream(folder / "mesh.ply", std::ios::binary).rdbuf();
    EXPECT_TRUE(binary.str().starts_with("ply\nformat binary_little_endian 1.0\n"));
    EXPECT_TRUE(binary.str().ends_with(std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13)));
}

// ---- files

TEST_F(MeshTest, files_that_cannot_be_read_or_written)
{
    fs::create_directory(folder / "folder.ply");
    const auto message = [&](const std::string& action, const std::string& name) {
        const fs::path file = folder / name;
        const std::string text = failure_of([&] {
            if (action == "read")
                read_mesh(file);
            else
                write_mesh(file, tetrahedron());
        });
        EXPECT_TRUE(text.starts_with("cannot " + action + " '" + file.string() + "': ")) << text;
        return text.substr(std::min(text.size(), action.size() + file.string().size() + 12));
    };
    EXPECT_EQ(message("read", "none.ply"), "there is no such file; check the path");
    EXPECT_EQ(message("read", "folder.ply"), "it is a folder; give the name of a mesh file");
    EXPECT_EQ(message("read", "cube.3ds"),
              "its extension is '.3ds', but meshes end in .ply, .obj, .stl, .off, .gltf or .glb");
    EXPECT_EQ(message("write", "cube.stl"),
              "its extension is '.stl', but meshes are written as .ply or .obj");
    EXPECT_EQ(message("write", "cube"), "it has no extension, but meshes are written as .ply or .obj");
    EXPECT_EQ(message("write", "folder.ply"), "it is a folder; give the name of a file");
    EXPECT_EQ(message("write", "none/cube.ply"),
              "there is no folder '" + (folder / "none").string() + "'; create it first");
    EXPECT_EQ(file_count(), 1u);
}

TEST_F(MeshTest, only_valid_meshes_are_written_and_inspected)
{
    SurfaceMesh mesh = tetrahedron();
    mesh.triangles[2][1] = 9;
    const std::string message = "triangle 2 of the mesh uses vertex 9, but there are only 4 vertices";
    EXPECT_EQ(failure_of([&] { write_mesh(folder / "mesh.ply", mesh); }), message);
    EXPECT_EQ(failure_of([&] { inspect_mesh(mesh); }), message);
    mesh = tetrahedron();
    mesh.vertices[3].y = std::numeric_limits<float>::infinity();
    EXPECT_EQ(failure_of([&] { inspect_mesh(mesh); }),
              "vertex 3 of the mesh has the coordinate inf; coordinates must be finite");
    EXPECT_NE(failure_of([&] { write_mesh(folder / "mesh.ply", {}); }), "no failure");
    EXPECT_EQ(file_count(), 0u);
}

TEST_F(MeshTest, atomic_file_appears_complete_or_not_at_all)
{
    const fs::path target = file_with("table.csv", "old");
    const auto contents = [&] {
        std::stringstream text;
        text << std::ifstream(target).rdbuf();
        return text.str();
    };
    {
        AtomicFile file(target);
        file.stream() << "never finished";
    }
    EXPECT_EQ(contents(), "old");
    EXPECT_EQ(file_count(), 1u);
    {
        AtomicFile file(target);
        file.stream() << "new" << std::flush;
        EXPECT_EQ(contents(), "old");
        file.commit();
    }
    EXPECT_EQ(contents(), "new");
    EXPECT_EQ(failure_of([&] {
                  AtomicFile file(target);
                  file.stream().setstate(std::ios::badbit);
                  file.commit();
              }),
              "cannot write '" + target.string() +
                  "': it could not be written completely; check the free space of the disk");
    EXPECT_EQ(contents(), "new");
    fs::create_symlink("table.csv", folder / "link.csv");
    {
        AtomicFile file(folder / "link.csv");
        file.stream() << "through the link";
        file.commit();
    }
    EXPECT_TRUE(fs::is_symlink(folder / "link.csv"));
    EXPECT_EQ(contents(), "through the link");
    EXPECT_EQ(file_count(), 2u);
}

TEST_F(MeshTest, atomic_file_never_replaces_a_device)
{
    if (!fs::is_character_file("/dev/null")) GTEST_SKIP() << "this system has no /dev/null";
    EXPECT_EQ(failure_of([] { AtomicFile file("/dev/null"); }),
              "cannot write '/dev/null': it exists and is not a regular file; give another name");
}

}  // namespace
}  // namespace pliant
