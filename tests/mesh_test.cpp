// Meshes: reading, writing, inspecting. Small files are written here by hand; the collection of bad files is
// read where it exists beside the repository.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <sstream>

#include "files/atomic_file.hpp"
#include "pliant/error.hpp"
#include "pliant/mesh.hpp"

#ifndef PLIANT_SHARED_DIR
#define PLIANT_SHARED_DIR PLIANT_SOURCE_DIR "/../shared"
#endif

namespace pliant {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test, removed afterwards.
class MeshTest : public testing::Test {
protected:
    void SetUp() override
    {
        folder =
            fs::path(testing::TempDir()) / ("pliant_mesh_test_" + std::to_string(std::random_device{}()));
        fs::create_directory(folder);
    }
    void TearDown() override { fs::remove_all(folder); }

    fs::path file_with(const std::string& name, const std::string& contents) const
    {
        std::ofstream(folder / name, std::ios::binary) << contents;
        return folder / name;
    }
    SurfaceMesh mesh_from(const std::string& name, const std::string& contents) const
    {
        return read_mesh(file_with(name, contents));
    }
    /// The message without the name of the file.
    std::string read_failure(const std::string& name, const std::string& contents) const;
    std::size_t file_count() const
    {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }

    fs::path folder;
};

std::string failure_of(const std::function<void()>& action)
{
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::bad_input);
        return error.what();
    }
    return "no failure";
}

std::string MeshTest::read_failure(const std::string& name, const std::string& contents) const
{
    const fs::path file = file_with(name, contents);
    std::string message = failure_of([&] { read_mesh(file); });
    if (const auto at = message.find(file.string()); at != std::string::npos)
        message.replace(at, file.string().size(), name);
    return message;
}

SurfaceMesh tetrahedron()
{
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

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

/// The bytes of a number in the order of the file.
template <class Number>
std::string bytes_of(Number value, std::endian order)
{
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

const std::string ascii_header =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

/// `ascii_header` with one piece replaced.
std::string header_with(const std::string& piece, const std::string& replacement)
{
    std::string header = ascii_header;
    return header.replace(header.find(piece), piece.size(), replacement);
}

const std::string three_rows = "0 0 0\n1 0 0\n0 1 0\n";

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

// ---- PLY

TEST_F(MeshTest, ply_ascii)
{
    const SurfaceMesh mesh =
        mesh_from("mesh.ply", ascii_header + "0 0 0\n+1 -0.5 1e-3\n\n  0\t1 .5  \n3 0 1 2");
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, -0.5f, 1e-3f}, {0, 1, 0.5f}}));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST_F(MeshTest, ply_binary_of_both_orders_with_everything_extra)
{
    for (const auto order : {std::endian::little, std::endian::big}) {
        std::string file =
            std::string("ply\r\nformat binary_") + (order == std::endian::little ? "little" : "big") +
            "_endian 1.0\r\ncomment element vertex 99\r\nobj_info x\r\n"
            "element vertex 3\r\nproperty uchar red\r\nproperty double z\r\nproperty short x\r\n"
            "property list ushort float weights\r\nproperty float32 y\r\n"
            "element nothing 18446744073709551615\r\n"
            "element material 1\r\nproperty list uint char name\r\nproperty int id\r\n"
            "element face 1\r\nproperty list int8 uint16 vertex_index\r\nproperty uint flags\r\n"
            "end_header\r\n";
        for (std::int16_t i = 0; i < 3; ++i) {
            file += '\xff' + bytes_of(0.5 * i, order) + bytes_of(i, order);
            file += bytes_of(static_cast<std::uint16_t>(i), order) +
                    std::string(4 * static_cast<std::size_t>(i), 'w');
            file += bytes_of(static_cast<float>(i * i), order);
        }
        file += bytes_of(std::uint32_t{4}, order) + "skin" + bytes_of(std::int32_t{7}, order);
        file += '\3' + bytes_of(std::uint16_t{2}, order) + bytes_of(std::uint16_t{0}, order) +
                bytes_of(std::uint16_t{1}, order) + bytes_of(std::uint32_t{5}, order);
        const SurfaceMesh mesh = mesh_from("mesh.ply", file);
        EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 1, 0.5f}, {2, 4, 1}}));
        EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{2, 0, 1}}));
        // Cut anywhere it must fail, and cleanly.
        for (std::size_t size = 1; size < file.size(); ++size)
            EXPECT_NE(failure_of([&] { mesh_from("cut.ply", file.substr(0, size)); }), "no failure") << size;
    }
}

TEST_F(MeshTest, ply_faces_may_stand_before_the_vertices)
{
    const SurfaceMesh mesh = mesh_from(
        "mesh.ply",
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 4\n"
        "property float x\nproperty float y\nproperty float z\nend_header\n"
        "4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n");
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST_F(MeshTest, ply_failures_say_what_is_wrong_and_where)
{
    struct Case {
        std::string contents, message;
    };
    const std::string binary_header = header_with("ascii", "binary_little_endian");
    const std::string floats(36, '\0');
    const std::vector<Case> cases = {
        {"", "cannot read 'bad.ply': it is empty (0 bytes); export the mesh again"},
        {"solid cube\n",
         "bad.ply, line 1: a PLY file begins with the line 'ply', but this one begins with 'solid cube'; is "
         "it another kind of file?"},
        {"ply\nformat ascii 1.0\n",
         "bad.ply, line 2: the file ends inside its header, before the line 'end_header'; export the mesh "
         "again"},
        {header_with("format ascii 1.0\n", ""),
         "bad.ply, line 8: the header has no 'format' line; add one such as 'format ascii 1.0'"},
        {header_with("vertex 3", "vertex -3"),
         "bad.ply, line 3: the count of element 'vertex' is '-3'; it must be a whole number, not negative "
         "and below 2^64"},
        {header_with("float z", "quaternion z"),
         "bad.ply, line 6: unknown type 'quaternion'; the types are char, uchar, short, ushort, int, uint, "
         "float, double and int8 to float64"},
        {header_with("float y", "float x"),
         "bad.ply, line 5: a second property 'x' of element 'vertex'; keep one"},
        {header_with("float z", "float w"),
         "bad.ply, line 3: element 'vertex' has no property 'z'; positions need x, y and z"},
        {header_with("list uchar int", "list uchar float"),
         "bad.ply, line 8: property 'vertex_indices' must be a list of an integer type such as int"},
        {header_with("vertex 3", "vertex 4000000000") + three_rows,
         "bad.ply, line 3: element 'vertex' claims a count of 4000000000, but the 18 bytes left in the "
         "file cannot hold that; the file is cut short or its header is wrong"},
        {ascii_header + "0 0 0\n0,5 0 0\n0 1 0\n3 0 1 2\n",
         "bad.ply, line 11: coordinate x of vertex 1 is '0,5'; it must be a finite number of single "
         "precision"},
        {ascii_header + "0 0 0\n1 0 1e39\n0 1 0\n3 0 1 2\n",
         "bad.ply, line 11: coordinate z of vertex 1 is '1e39'; it must be a finite number of single "
         "precision"},
        {ascii_header + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n",
         "bad.ply, line 11: the line of vertex 1 ends before its property 'z'; a row must stand complete on "
         "one line"},
        {ascii_header + "0 0 0\n1 0 0 0\n0 1 0\n3 0 1 2\n",
         "bad.ply, line 11: vertex 1 has more values than the header promises, from '0' on; compare the "
         "counts and properties of the header with the rows"},
        {ascii_header + three_rows + "3 0 1 3\n",
         "bad.ply, line 13: face 0 uses vertex 3, but the vertices are 0 to 2; correct the index"},
        {ascii_header + three_rows + "3 0 1 -1\n",
         "bad.ply, line 13: face 0 uses vertex -1, but the vertices are 0 to 2; correct the index"},
        {ascii_header + three_rows + "2 0 1\n",
         "bad.ply, line 13: face 0 has 2 corners; remove it, a face needs at least 3"},
        {ascii_header + three_rows + "3 0 1 2.5\n",
         "bad.ply, line 13: property 'vertex_indices' of face 0 has the value '2.5'; it must be a whole "
         "number"},
        {header_with("face 1", "face 3") + three_rows + "3 0 1 2\n",
         "bad.ply, line 13: the file ends before face 1 (of 3, the first is 0); it is cut short or its "
         "header is wrong"},
        {binary_header + floats,
         "bad.ply, byte 205: element 'face' claims a count of 1, but the 0 bytes left in the file "
         "cannot hold that; the file is cut short or its header is wrong"},
        {binary_header + floats.substr(0, 32) + bytes_of(std::nanf(""), std::endian::little) + '\3',
         "bad.ply, byte 201: coordinate z of vertex 2 is nan; it must be a finite number of single "
         "precision"},
        {binary_header + floats + "\3abcd",
         "bad.ply, byte 205: list 'vertex_indices' of face 0 (of 1, the first is 0) claims 3 values, but 1 "
         "fit into the rest of the file; the file is cut short or damaged"},
    };
    for (const Case& bad : cases) EXPECT_EQ(read_failure("bad.ply", bad.contents), bad.message);
}

// ---- OBJ

TEST_F(MeshTest, obj_forms_of_faces)
{
    std::string text =
        "# a comment with a backslash \\\n"
        "mtllib none.mtl\no thing\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.1 0.2 0.3\nvt 0 0\nvn 0 0 1\n"
        "f 1 2 3 # plain\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\n"
        "\tf -3 \\\n -2/ \\\n -1\n"
        "v 0 1 0\nf -4 -3 -2 -1\nl 1 2\nf 1 2 5\nv 5 5 5";
    const SurfaceMesh mesh = mesh_from("mesh.obj", text);
    EXPECT_EQ(mesh.vertices.size(), 5u);
    const Triangle first{0, 1, 2};
    EXPECT_EQ(mesh.triangles,
              (std::vector<Triangle>{first, first, first, first, first, {0, 1, 2}, {0, 2, 3}, {0, 1, 4}}));

    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
        text.insert(at, 1, '\r');
    EXPECT_EQ(mesh_from("windows.obj", "\xef\xbb\xbf" + text).triangles, mesh.triangles);
}

TEST_F(MeshTest, obj_failures_say_what_is_wrong_and_where)
{
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"# nothing\n", "bad.obj: the mesh has no vertices; export it again"},
        {"<html>\n", "bad.obj, line 1: unknown statement '<html>'; is it an OBJ file?"},
        {"v 0 0\n", "bad.obj, line 1: the vertex has 2 numbers; write x, y and z"},
        {"v 0 0 nan\n",
         "bad.obj, line 1: number 3 of the vertex is 'nan'; it must be a finite number of single precision"},
        {"v 0 \\\n0 \\\nzero\n",
         "bad.obj, line 1: number 3 of the vertex is 'zero'; it must be a finite number of single precision"},
        {vertices + "f 1 2\n", "bad.obj, line 4: the face has 2 corners; remove it, a face needs at least 3"},
        {vertices + "f 0 1 2\n",
         "bad.obj, line 4: the face uses vertex 0; vertices of OBJ files are numbered from 1"},
        {vertices + "f 1 2 4\n",
         "bad.obj, line 4: the face uses vertex 4, but the vertices are 1 to 3; correct the index"},
        {vertices + "f 1 2 4294967299\n",
         "bad.obj, line 4: the face uses vertex 4294967299, more than any mesh can have; correct the index"},
        {vertices + "f -1 -2 -4\n",
         "bad.obj, line 4: the face uses vertex -4, but only 3 vertices stand before it; correct the index"},
        {vertices + "f 1 2 3/x\n",
         "bad.obj, line 4: the corner '3/x' of the face is not of the form v, v/vt, v//vn or v/vt/vn"},
    };
    for (const auto& [contents, message] : cases) EXPECT_EQ(read_failure("bad.obj", contents), message);
}

// ---- polygons

/// The polygon as an OBJ face in the plane z = 0.
std::string polygon_obj(const std::vector<std::pair<double, double>>& corners)
{
    std::ostringstream text;
    text.precision(9);
    for (const auto& [x, y] : corners) text << "v " << x << ' ' << y << " 0\n";
    text << 'f';
    for (std::size_t i = 1; i <= corners.size(); ++i) text << ' ' << i;
    return text.str();
}

TEST_F(MeshTest, polygons_become_triangles_that_do_not_overlap)
{
    using Corners = std::vector<std::pair<double, double>>;
    const std::vector<std::pair<Corners, double>> polygons = {
        {{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 3},  // an L
        {{{2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 0}, {2, 0}}, 3},  // the same from another corner
        {{{0, 0}, {1, 3}, {0, 1}, {-1, 3}}, 1},                 // a dart
        {{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}, 4},          // a corner on a straight side
        {{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}},
         12},  // a hole with a bridge
    };
    for (const auto& [corners, area] : polygons) {
        const SurfaceMesh mesh = mesh_from("polygon.obj", polygon_obj(corners));
        const MeshReport report = inspect_mesh(mesh);
        EXPECT_EQ(report.triangles, corners.size() - 2);
        EXPECT_EQ(report.degenerate_triangles, 0u);
        EXPECT_NEAR(report.area, area, 1e-12);  // overlapping triangles would add up to more
        EXPECT_TRUE(report.oriented);
    }
}

TEST_F(MeshTest, random_star_shaped_polygons_keep_their_area)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> radius(0.1, 1);
    for (const int n : {4, 5, 7, 31, 200, 1000}) {
        std::vector<std::pair<double, double>> corners;
        for (int i = 0; i < n; ++i) {
            const double turn = 2 * std::numbers::pi * i / n, r = radius(random);
            corners.emplace_back(r * std::cos(turn), r * std::sin(turn));
        }
        double area = 0;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto [x, y] = corners[i];
            const auto [u, v] = corners[(i + 1) % corners.size()];
            area += (x * v - u * y) / 2;
        }
        const MeshReport report = inspect_mesh(mesh_from("star.obj", polygon_obj(corners)));
        EXPECT_EQ(report.triangles, corners.size() - 2);
        EXPECT_NEAR(report.area, area, 1e-5 * area) << n;
    }
}

TEST_F(MeshTest, long_polygons_take_no_quadratic_time)
{
    std::vector<std::pair<double, double>> corners;
    for (int i = 0; i < 1001; ++i) corners.emplace_back(i, i % 2);
    corners.emplace_back(500, 1000);
    EXPECT_EQ(read_failure("comb.obj", polygon_obj(corners)),
              "comb.obj, line 1003: the face has 1002 corners and is not convex; triangulate the mesh "
              "before, "
              "above 1000 corners it is not done here");
    corners.clear();
    for (int i = 0; i < 5000; ++i)
        corners.emplace_back(1000 * std::cos(2 * std::numbers::pi * i / 5000),
                             1000 * std::sin(2 * std::numbers::pi * i / 5000));
    EXPECT_EQ(mesh_from("circle.obj", polygon_obj(corners)).triangles.size(), 4998u);
}

TEST_F(MeshTest, polygons_that_are_none_still_become_triangles)
{
    EXPECT_EQ(mesh_from("bow.obj", polygon_obj({{0, 0}, {1, 1}, {1, 0}, {0, 1}})).triangles.size(), 2u);
    EXPECT_EQ(mesh_from("point.obj", polygon_obj({{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}})).triangles.size(),
              3u);
    EXPECT_EQ(mesh_from("line.obj", polygon_obj({{0, 0}, {1, 0}, {2, 0}, {3, 0}})).triangles.size(), 2u);
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
    EXPECT_EQ(message("read", "cube.STL"), "its ending is '.STL', but meshes end in .ply or .obj");
    EXPECT_EQ(message("write", "cube"), "it has no ending, but meshes end in .ply or .obj");
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
                  "': not everything could be written; check the free space of the disk");
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
              "cannot write '/dev/null': it exists and is no plain file; give another name");
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
              "surface: closed, consistently oriented, Euler characteristic 2\n"
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

TEST(MeshInspection, moebius_strip_cannot_be_oriented)
{
    const MeshReport report = inspect_mesh(moebius_strip(24));
    EXPECT_FALSE(report.oriented);
    EXPECT_FALSE(report.closed);
    EXPECT_EQ(report.boundary_edges, 48u);
    EXPECT_EQ(report.boundary_loops, 1u);
    EXPECT_EQ(report.euler_characteristic, 0);
    EXPECT_EQ(report.non_manifold_edges + report.non_manifold_vertices, 0u);
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
    EXPECT_NE(describe(report).find("1 non-manifold vertex (more than one fan)\n"), std::string::npos);
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

// ---- the collection beside the repository

TEST(SharedMeshes, bad_files_are_refused_and_odd_ones_read)
{
    const fs::path bad = fs::path(PLIANT_SHARED_DIR) / "meshes" / "bad";
    if (!fs::exists(bad / "manifest.json")) GTEST_SKIP() << "no collection of bad meshes at " << bad;
    const auto manifest = nlohmann::json::parse(std::ifstream(bad / "manifest.json"));
    std::size_t checked = 0;
    for (const auto& entry : manifest.at("files")) {
        const std::string name = entry.at("file"), parse = entry.at("parse");
        SCOPED_TRACE(name + ": " + entry.at("what").get<std::string>());
        const auto begin = std::chrono::steady_clock::now();
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
        } catch (const Error& error) {
            EXPECT_NE(parse, "ok") << error.what();
            EXPECT_EQ(error.kind, ErrorKind::bad_input);
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
            EXPECT_LT(std::string(error.what()).size(), 300 + bad.string().size());
        }
        EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
        ++checked;
    }
    std::cout << checked << " files of the manifest checked\n";
}

TEST(SharedMeshes, measures_agree_with_the_published_ones)
{
    const fs::path file = fs::path(PLIANT_SHARED_DIR) / "meshes" / "bunny_8k.ply";
    if (!fs::exists(file)) GTEST_SKIP() << "no mesh at " << file;
    const MeshReport report = inspect_mesh(read_mesh(file));
    EXPECT_EQ(report.edges, 23871u);
    EXPECT_NEAR(report.volume, 0.385162, 1e-6);
    EXPECT_NEAR(report.area, 3.676803, 1e-6);
    EXPECT_NEAR(report.edge_mean, 0.02316, 1e-5);
    EXPECT_TRUE(report.closed && report.oriented);
}

}  // namespace
}  // namespace pliant
