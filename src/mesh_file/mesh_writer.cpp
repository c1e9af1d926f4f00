// Writers: PLY (binary little-endian) and OBJ. Both preserve every float exactly.
#include <bit>

#include "files/formatted.hpp"
#include "mesh_file/mesh_formats.hpp"
#include "mesh_file/text_scan.hpp"

namespace pliant {

namespace {

/// Appends the bytes of a number, lowest first on every machine.
void append_little_endian(std::string& bytes, std::uint32_t value)
{
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((value >> shift) & 0xffu);
}

void append_little_endian(std::string& bytes, float value)
{
    append_little_endian(bytes, std::bit_cast<std::uint32_t>(value));
}

}  // namespace

void write_ply(std::ostream& out, const SurfaceMesh& mesh)
{
    out << "ply\nformat binary_little_endian 1.0\ncomment Pliant, positions in m\n"
        << "element vertex " << mesh.vertices.size()
        << "\nproperty float x\nproperty float y\nproperty float z\n"
        << "element face " << mesh.triangles.size()
        << "\nproperty list uchar uint vertex_indices\nend_header\n";
    std::string row;
    for (const Vec3 v : mesh.vertices) {
        row.clear();
        for (const float value : {v.x, v.y, v.z}) append_little_endian(row, value);
        out << row;
    }
    for (const Triangle& triangle : mesh.triangles) {
        row.assign(1, '\3');
        for (const std::uint32_t index : triangle) append_little_endian(row, index);
        out << row;
    }
}

void write_obj(std::ostream& out, const SurfaceMesh& mesh)
{
    out << "# Pliant, positions in m\n";
    for (const Vec3 v : mesh.vertices)
        out << "v " << number_text(v.x) << ' ' << number_text(v.y) << ' ' << number_text(v.z) << '\n';
    for (const Triangle& triangle : mesh.triangles) {
        out << 'f';
        for (const std::uint32_t index : triangle) out << ' ' << std::uint64_t{index} + 1;
        out << '\n';
    }
}

}  // namespace pliant
