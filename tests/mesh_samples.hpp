// One mesh as bytes in every format that is read.
#pragma once

#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>

#include "pliant/mesh.hpp"

namespace pliant::test {

template <class Number>
void append_bytes(std::string& bytes, Number value)
{
    char raw[sizeof value];
    std::memcpy(raw, &value,
                sizeof value);  // the machines of the tests are little-endian, as the formats are
    bytes.append(raw, sizeof value);
}

inline std::string ascii_ply_of(const SurfaceMesh& mesh)
{
    std::ostringstream text;
    text.precision(9);
    text << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.size()
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.triangles.size()
         << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Vec3 v : mesh.vertices) text << v.x << ' ' << v.y << ' ' << v.z << '\n';
    for (const Triangle& t : mesh.triangles) text << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    return text.str();
}

inline std::string text_stl_of(const SurfaceMesh& mesh)
{
    std::ostringstream text;
    text.precision(9);
    text << "solid shape\n";
    for (const Triangle& t : mesh.triangles) {
        text << "  facet normal 0 0 0\n    outer loop\n";
        for (const std::uint32_t i : t)
            text << "      vertex " << mesh.vertices[i].x << ' ' << mesh.vertices[i].y << ' '
                 << mesh.vertices[i].z << '\n';
        text << "    endloop\n  endfacet\n";
    }
    text << "endsolid shape\n";
    return text.str();
}

inline std::string binary_stl_of(const SurfaceMesh& mesh)
{
    std::string bytes(80, ' ');
    append_bytes(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const Triangle& t : mesh.triangles) {
        bytes.append(12, '\0');
        for (const std::uint32_t i : t) {
            append_bytes(bytes, mesh.vertices[i].x);
            append_bytes(bytes, mesh.vertices[i].y);
            append_bytes(bytes, mesh.vertices[i].z);
        }
        bytes.append(2, '\0');
    }
    return bytes;
}

inline std::string off_of(const SurfaceMesh& mesh)
{
    std::ostringstream text;
    text.precision(9);
    text << "OFF\n" << mesh.vertices.size() << ' ' << mesh.triangles.size() << " 0\n";
    for (const Vec3 v : mesh.vertices) text << v.x << ' ' << v.y << ' ' << v.z << '\n';
    for (const Triangle& t : mesh.triangles) text << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    return text.str();
}

/// The binary buffer of a glTF file: positions, then indices.
inline std::string gltf_buffer_of(const SurfaceMesh& mesh)
{
    std::string bytes;
    for (const Vec3 v : mesh.vertices) append_bytes(bytes, v);
    for (const Triangle& t : mesh.triangles) append_bytes(bytes, t);
    return bytes;
}

/// `buffer`: what stands in "buffers" beside the length, as in ",\"uri\":\"shape.bin\"".
inline std::string gltf_text_of(const SurfaceMesh& mesh, const std::string& buffer,
                                const std::string& nodes = R"([{"mesh":0}])",
                                const std::string& roots = "[0]")
{
    const std::size_t places = 12 * mesh.vertices.size(), corners = 12 * mesh.triangles.size();
    std::ostringstream text;
    text << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":)" << roots << R"(}],"nodes":)"
         << nodes << R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)"
         << R"({"bufferView":0,"componentType":5126,"count":)" << mesh.vertices.size()
         << R"(,"type":"VEC3","min":[-9,-9,-9],"max":[9,9,9]},{"bufferView":1,"componentType":5125,"count":)"
         << 3 * mesh.triangles.size() << R"(,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":)"
         << places << R"(},{"buffer":0,"byteOffset":)" << places << R"(,"byteLength":)" << corners
         << R"(}],"buffers":[{"byteLength":)" << places + corners << buffer << "}]}";
    return text.str();
}

inline std::string glb_of(const SurfaceMesh& mesh)
{
    std::string json = gltf_text_of(mesh, "");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string buffer = gltf_buffer_of(mesh);
    std::string bytes = "glTF";
    append_bytes(bytes, std::uint32_t{2});
    append_bytes(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + buffer.size()));
    append_bytes(bytes, static_cast<std::uint32_t>(json.size()));
    bytes += "JSON" + json;
    append_bytes(bytes, static_cast<std::uint32_t>(buffer.size()));
    return bytes + std::string("BIN\0", 4) + buffer;
}

}  // namespace pliant::test
