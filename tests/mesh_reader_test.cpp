// Meshes are read: PLY, OBJ, and polygons, which become triangles. The files are written here by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <sstream>

#include "test_meshes.hpp"

namespace pliant {
namespace {

using test::failure_of;
using test::MeshTest;

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
         "bad.obj, line 4: the face uses vertex -4, but only 3 vertices precede it; correct the index"},
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
              "first: the limit is 1000 corners");
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

}  // namespace
}  // namespace pliant
