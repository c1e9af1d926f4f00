// read_mesh and write_mesh: the file's extension chooses the format.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <new>

#include "files/atomic_file.hpp"
#include "files/numbered_name.hpp"
#include "mesh/mesh_topology.hpp"
#include "mesh_file/mesh_formats.hpp"
#include "mesh_file/text_scan.hpp"
#include "pliant/error.hpp"

namespace pliant {

namespace {

struct MeshFormat {
    std::string_view ending;
    SurfaceMesh (*read)(const MeshSource&);
    void (*write)(std::ostream&, const SurfaceMesh&);  ///< null: the format is only read
};
constexpr std::array formats = {MeshFormat{".ply", read_ply, write_ply},
                                MeshFormat{".obj", read_obj, write_obj},
#if PLIANT_MESH_IMPORT
                                MeshFormat{".stl", read_stl, nullptr},
                                MeshFormat{".off", read_off, nullptr},
                                MeshFormat{".gltf", read_gltf, nullptr},
                                MeshFormat{".glb", read_gltf, nullptr}
#endif
};

[[noreturn]] void fail(std::string_view action, const std::filesystem::path& file, const std::string& reason)
{
    throw Error(ErrorKind::bad_input,
                "cannot " + std::string(action) + " '" + file.string() + "': " + reason);
}

/// ".ply, .obj or .stl": all formats, or those that can be written.
std::string endings(bool written)
{
    std::vector<std::string> names;
    for (const MeshFormat& format : formats)
        if (!written || format.write) names.emplace_back(format.ending);
    std::string list = names[0];
    for (std::size_t i = 1; i < names.size(); ++i) list += (i + 1 < names.size() ? ", " : " or ") + names[i];
    return list;
}

const MeshFormat& format_of(const std::filesystem::path& file, bool written)
{
    const std::string found = lower_case_ending(file);
    for (const MeshFormat& format : formats)
        if (format.ending == found && (!written || format.write)) return format;
    const std::string ending = file.extension().string();
    fail(written ? "write" : "read", file,
         (ending.empty() ? "it has no extension" : "its extension is " + in_quotes(ending)) +
             ", but meshes " + (written ? "are written as " : "end in ") + endings(written));
}

std::string file_contents(const std::filesystem::path& file)
{
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) fail("read", file, "there is no such file; check the path");
    if (std::filesystem::is_directory(status))
        fail("read", file, "it is a folder; give the name of a mesh file");
    // A pipe could block for ever, and a device never end.
    if (!std::filesystem::is_regular_file(status))
        fail("read", file, "it is not a regular file; save the mesh to one");

    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail("read", file, "it cannot be opened; check the permissions");
    const auto size = std::filesystem::file_size(file, error);
    if (error) fail("read", file, "its size cannot be determined (" + error.message() + ")");
    if (size == 0) fail("read", file, "it is empty (0 bytes); export the mesh again");

    std::string contents(size, '\0');
    stream.read(contents.data(), static_cast<std::streamsize>(size));
    if (static_cast<std::uintmax_t>(stream.gcount()) != size)
        fail("read", file, "it became shorter while it was read; try again");
    return contents;
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& file)
{
    return std::ranges::find(formats, std::string_view(lower_case_ending(file)), &MeshFormat::ending) !=
           formats.end();
}

std::vector<float> read_vertex_attribute(const std::filesystem::path& file, const std::string& name)
{
    if (format_of(file, false).read != read_ply)
        fail("read", file,
             "only a .ply file has properties of vertices; the property " + in_quotes(name) +
                 " was asked for");
    const std::string contents = file_contents(file);
    return read_ply_attribute({file.string(), contents}, name);
}

SurfaceMesh read_mesh(const std::filesystem::path& file)
{
    const MeshFormat& format = format_of(file, false);
    try {
        const std::string contents = file_contents(file);
        SurfaceMesh mesh = format.read({file.string(), contents});
        mesh.file = file;
        return mesh;
    } catch (const std::bad_alloc&) {
        fail("read", file, "it does not fit into memory; use a smaller mesh");
    }
}

void write_mesh(const std::filesystem::path& file, const SurfaceMesh& mesh)
{
    const MeshFormat& format = format_of(file, true);
    // What is written can be read again.
    if (mesh.vertices.empty()) fail("write", file, "the mesh has no vertices");
    require_valid(mesh);
    AtomicFile target(file);
    format.write(target.stream(), mesh);
    target.commit();
}

void mesh_error(const MeshSource& source, const std::string& message)
{
    throw Error(ErrorKind::bad_input, source.name + ": " + message);
}

void mesh_error_at_line(const MeshSource& source, std::size_t line, const std::string& message)
{
    throw Error(ErrorKind::bad_input, source.name + ", line " + std::to_string(line) + ": " + message);
}

void mesh_error_at_byte(const MeshSource& source, std::size_t byte, const std::string& message)
{
    throw Error(ErrorKind::bad_input, source.name + ", byte " + std::to_string(byte) + ": " + message);
}

}  // namespace pliant
