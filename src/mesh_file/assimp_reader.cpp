// Reads STL, OFF and glTF with assimp; the only file that uses it. Assimp trusts the counts in a file, so
// those of STL and OFF are checked first. Of a binary glTF file only the chunk lengths are checked, of a
// .gltf nothing. The resulting mesh is checked afterwards.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "files/formatted.hpp"
#include "files/numbered_name.hpp"
#include "mesh/mesh_welding.hpp"
#include "mesh_file/mesh_formats.hpp"
#include "mesh_file/polygon.hpp"
#include "mesh_file/text_scan.hpp"

namespace pliant {
namespace {

/// The number of triangles in the file, if it is known before assimp reads it.
using Expected = std::optional<std::uint64_t>;

std::uint32_t little_endian_at(std::string_view bytes, std::size_t position)
{
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[position + i]);
    return value;
}

/// "solid ... facet ... endsolid": the first word after the name must be a keyword, since headers of binary
/// files may also begin with "solid".
bool is_text_stl(std::string_view bytes)
{
    bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
    if (!bytes.starts_with("solid")) return false;
    LineScanner lines(bytes.substr(0, 4096));
    lines.next();
    while (lines.next()) {
        const std::string_view word = WordScanner(lines.line()).next();
        if (!word.empty()) return word == "facet" || word == "endsolid";
    }
    return false;
}

/// Every line must follow the format, and every facet be complete: three vertices of three finite numbers.
Expected triangles_of_text_stl(const MeshSource& source)
{
    LineScanner lines(source.bytes);
    std::uint64_t facets = 0;
    int corners = 0;
    bool open = false, ended = false;
    while (lines.next()) {
        WordScanner words(lines.line());
        const std::string_view word = words.next();
        if (!word.empty()) ended = word == "endsolid";
        const auto fail = [&](const std::string& message) {
            mesh_error_at_line(source, lines.number(), message);
        };
        if (word == "facet") {
            if (open) fail("a facet begins in another one; 'endfacet' is missing");
            open = true;
            corners = 0;
        } else if (word == "vertex") {
            for (int i = 0; i < 3; ++i)
                if (const auto number = words.next(); !float_from(number))
                    fail("a vertex has " + in_quotes(number) + " where a finite number must be");
            ++corners;
        } else if (word == "endfacet") {
            if (!open || corners != 3) fail("a facet has " + std::to_string(corners) + " vertices, not 3");
            open = false;
            ++facets;
        } else if (word != "solid" && word != "endsolid" && word != "outer" && word != "endloop" &&
                   !word.empty()) {
            fail("unknown word " + in_quotes(word) + "; is it an STL file?");
        }
    }
    if (open || !ended) mesh_error(source, "it ends without 'endsolid'; export the mesh again");
    return facets;
}

Expected triangles_of_stl(const MeshSource& source)
{
    constexpr std::uint64_t header = 84, row = 50;
    if (is_text_stl(source.bytes)) return triangles_of_text_stl(source);
    if (source.bytes.size() < header)
        mesh_error(source, "it has " + std::to_string(source.bytes.size()) +
                               " bytes, but a binary STL file begins with 84; export the mesh again");
    const std::uint64_t count = little_endian_at(source.bytes, 80), needed = header + row * count;
    if (source.bytes.size() < needed)
        mesh_error(source, "it declares " + std::to_string(count) + " triangles, which take " +
                               std::to_string(needed) + " bytes, but it has " +
                               std::to_string(source.bytes.size()) + "; export the mesh again");
    for (std::uint64_t i = 0; i < count; ++i)
        for (std::uint64_t k = 3; k < 12; ++k) {
            float value = 0;
            const std::uint32_t bits = little_endian_at(source.bytes, header + row * i + 4 * k);
            std::memcpy(&value, &bits, sizeof value);
            if (!std::isfinite(value))
                mesh_error_at_byte(source, header + row * i + 4 * k,
                                   "triangle " + std::to_string(i) + " has the coordinate " +
                                       number_text(value) + "; coordinates must be finite");
        }
    return count;
}

/// The words of an OFF file, without its comments.
class OffWords {
public:
    explicit OffWords(const MeshSource& source) : lines_(source.bytes), words_("") {}
    std::string_view next()
    {
        for (;;) {
            if (const std::string_view word = words_.next(); !word.empty()) return word;
            if (!lines_.next()) return {};
            words_ = WordScanner(lines_.line().substr(0, lines_.line().find('#')));
        }
    }
    /// Skips the rest of the line, up to the next line with words.
    void next_line() { words_ = WordScanner(""); }
    std::size_t line() const { return lines_.number(); }

private:
    LineScanner lines_;
    WordScanner words_;
};

/// "OFF", three counts, vertices, faces; faces may have colours after their corners.
Expected triangles_of_off(const MeshSource& source)
{
    OffWords words(source);
    const auto fail = [&](const std::string& message) { mesh_error_at_line(source, words.line(), message); };
    if (const auto magic = words.next(); magic != "OFF")
        fail("it begins with " + in_quotes(magic) +
             ", but must with 'OFF' (without colours, normals or a fourth coordinate)");
    std::array<std::uint64_t, 3> counts{};
    for (std::uint64_t& count : counts) {
        const std::string_view word = words.next();
        const auto value = count_from(word);
        if (!value) fail(in_quotes(word) + " is not a count of vertices, faces or edges");
        count = *value;
    }
    const auto [vertices, faces, edges] = counts;
    constexpr std::uint64_t shortest_row = 5;  // "0 0 0", and "3 0 1 2" is longer
    if (vertices > source.bytes.size() / shortest_row || faces > source.bytes.size() / shortest_row)
        fail("it declares " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
             " faces, more than a file of " + std::to_string(source.bytes.size()) + " bytes can hold");
    for (std::uint64_t i = 0; i < vertices; ++i) {
        words.next_line();
        for (int axis = 0; axis < 3; ++axis)
            if (const auto word = words.next(); !float_from(word))
                fail("vertex " + std::to_string(i) + " has " + in_quotes(word) +
                     " where a finite number must be");
    }
    std::uint64_t triangles = 0;
    for (std::uint64_t i = 0; i < faces; ++i) {
        words.next_line();
        const std::string_view word = words.next();
        const auto corners = count_from(word);
        if (!corners || *corners < 3 || *corners > concave_corner_limit)
            fail("face " + std::to_string(i) + " has " + in_quotes(word) + " corners; a face has 3 to " +
                 std::to_string(concave_corner_limit));
        for (std::uint64_t k = 0; k < *corners; ++k) {
            const std::string_view index = words.next();
            const auto vertex = count_from(index);
            if (!vertex || *vertex >= vertices)
                fail("face " + std::to_string(i) + " uses vertex " + in_quotes(index) + ", but there are " +
                     std::to_string(vertices) + " vertices; correct the index");
        }
        triangles += *corners - 2;
    }
    return triangles;
}

/// The chunk lengths of a binary glTF file (glTF 2.0 specification, section 4.4): assimp would allocate
/// memory for any length.
void check_frame_of_glb(const MeshSource& source)
{
    const std::string_view bytes = source.bytes;
    constexpr std::size_t header = 12, chunk_header = 8;
    if (!bytes.starts_with("glTF") || bytes.size() < header + chunk_header)
        mesh_error(source, "it does not begin as a binary glTF file; export the mesh again");
    if (const auto version = little_endian_at(bytes, 4); version != 2)
        mesh_error_at_byte(source, 4,
                           "glTF version " + std::to_string(version) + " is unknown; export as version 2");
    if (const auto length = little_endian_at(bytes, 8); length != bytes.size())
        mesh_error_at_byte(source, 8,
                           "it declares " + std::to_string(length) + " bytes, but has " +
                               std::to_string(bytes.size()) + "; export the mesh again");
    std::size_t position = header;
    while (position < bytes.size()) {
        const std::size_t left = bytes.size() - position;
        const std::uint64_t length = left < chunk_header ? 0 : little_endian_at(bytes, position);
        if (left < chunk_header || length > left - chunk_header)
            mesh_error_at_byte(
                source, position,
                "a chunk of " + std::to_string(length) + " bytes goes beyond the end; export the mesh again");
        if (position == header && bytes.substr(position + 4, 4) != "JSON")
            mesh_error_at_byte(source, position + 4,
                               "the first chunk is not of type JSON; export the mesh again");
        position += chunk_header + static_cast<std::size_t>(length);
    }
}

/// All instances of meshes in a scene's tree, each with its transformation.
void add_nodes(const MeshSource& source, const aiScene& scene, SurfaceMesh& result)
{
    struct Visit {
        const aiNode* node;
        aiMatrix4x4 to_world;
    };
    std::vector<Visit> open = {{scene.mRootNode, scene.mRootNode->mTransformation}};
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        for (unsigned i = visit.node->mNumChildren; i-- > 0;)
            open.push_back(
                {visit.node->mChildren[i], visit.to_world * visit.node->mChildren[i]->mTransformation});
        const bool mirrored = visit.to_world.Determinant() < 0;
        for (unsigned m = 0; m < visit.node->mNumMeshes; ++m) {
            const aiMesh& mesh = *scene.mMeshes[visit.node->mMeshes[m]];
            const std::size_t first = result.vertices.size();
            if (first + mesh.mNumVertices >= std::numeric_limits<std::uint32_t>::max())
                mesh_error(source, "the mesh has more than 4294967294 vertices");
            for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
                const aiVector3D v = visit.to_world * mesh.mVertices[i];
                result.vertices.push_back({v.x, v.y, v.z});
            }
            for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
                const aiFace& face = mesh.mFaces[i];
                if (face.mNumIndices != 3) continue;  // skips points and lines
                Triangle triangle;
                for (unsigned k = 0; k < 3; ++k) {
                    if (face.mIndices[k] >= mesh.mNumVertices)
                        mesh_error(source, "a triangle uses vertex " + std::to_string(face.mIndices[k]) +
                                               ", but there are " + std::to_string(mesh.mNumVertices) +
                                               " vertices; export the mesh again");
                    triangle[k] = static_cast<std::uint32_t>(first + face.mIndices[k]);
                }
                if (mirrored) std::swap(triangle[1], triangle[2]);
                result.triangles.push_back(triangle);
            }
        }
    }
}

/// Assimp's error message, as the end of a sentence.
std::string reason_of(const std::string& text)
{
    std::string reason = text.substr(0, text.find('\n'));
    while (reason.ends_with('.') || reason.ends_with(' ')) reason.pop_back();
    constexpr std::size_t longest = 120;
    std::string result;
    for (const char c : reason.substr(0, longest)) result += c >= ' ' && c <= '~' ? c : '?';
    return result.empty() ? "no reason is known" : result;
}

SurfaceMesh read_by_assimp(const MeshSource& source, Expected expected)
{
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const aiScene* scene = importer.ReadFile(source.name, aiProcess_Triangulate | aiProcess_SortByPType);
    if (!scene || !scene->mRootNode || (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0)
        mesh_error(source, "it cannot be read (" + reason_of(importer.GetErrorString()) +
                               "); export the mesh again, or as .ply");
    SurfaceMesh mesh;
    add_nodes(source, *scene, mesh);
    if (mesh.triangles.empty()) mesh_error(source, "the mesh has no triangles; export it again");
    if (expected && *expected != mesh.triangles.size())
        mesh_error(source, "it holds " + std::to_string(*expected) + " triangles, of which " +
                               std::to_string(mesh.triangles.size()) +
                               " could be read; export the mesh as .ply");
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        for (const float value : {mesh.vertices[i].x, mesh.vertices[i].y, mesh.vertices[i].z})
            if (!std::isfinite(value))
                mesh_error(source, "vertex " + std::to_string(i) + " has the coordinate " +
                                       number_text(value) + "; coordinates must be finite");
    return mesh;
}

}  // namespace

SurfaceMesh read_stl(const MeshSource& source)
{
    SurfaceMesh mesh = read_by_assimp(source, triangles_of_stl(source));
    weld_vertices(mesh, 0);  // each triangle of an STL file has its own vertices
    return mesh;
}

SurfaceMesh read_off(const MeshSource& source) { return read_by_assimp(source, triangles_of_off(source)); }

SurfaceMesh read_gltf(const MeshSource& source)
{
    if (source.bytes.starts_with("glTF") || lower_case_ending(source.name) == ".glb")
        check_frame_of_glb(source);
    SurfaceMesh mesh = read_by_assimp(source, {});
    weld_vertices(mesh, 0);  // vertices are repeated at seams of normals or textures
    return mesh;
}

}  // namespace pliant
