// PLY reader: Turk, The PLY Polygon File Format, 1994. Reads x, y, z of element 'vertex' and the corners of
// element 'face'; skips everything else, which must still be complete.
#include <array>
#include <limits>

#include "mesh_file/mesh_formats.hpp"
#include "mesh_file/ply_header.hpp"
#include "mesh_file/ply_rows.hpp"
#include "mesh_file/polygon.hpp"
#include "mesh_file/text_scan.hpp"

namespace pliant {

namespace {

constexpr std::array<std::string_view, 3> coordinate_names = {"x", "y", "z"};

/// The elements and properties of the mesh in the file.
struct PlyLayout {
    const PlyElement* vertex = nullptr;
    const PlyElement* face = nullptr;  ///< absent in a point cloud
    std::array<const PlyProperty*, 3> coordinates{};
    const PlyProperty* corners = nullptr;
};

const PlyElement* element_named(const MeshSource& source, const PlyHeader& header, std::string_view name)
{
    const PlyElement* found = nullptr;
    for (const PlyElement& element : header.elements) {
        if (element.name != name) continue;
        if (found)
            mesh_error_at_line(source, element.line, "a second element " + in_quotes(name) + "; keep one");
        found = &element;
    }
    return found;
}

const PlyProperty* property_named(const MeshSource& source, const PlyElement& element, std::string_view name)
{
    const PlyProperty* found = nullptr;
    for (const PlyProperty& property : element.properties) {
        if (property.name != name) continue;
        if (found)
            mesh_error_at_line(source, property.line,
                               "a second property " + in_quotes(name) + " of element " +
                                   in_quotes(element.name) + "; keep one");
        found = &property;
    }
    return found;
}

const PlyProperty* coordinate_property(const MeshSource& source, const PlyElement& vertex,
                                       std::string_view name)
{
    const PlyProperty* property = property_named(source, vertex, name);
    if (!property)
        mesh_error_at_line(
            source, vertex.line,
            "element 'vertex' has no property " + in_quotes(name) + "; positions need x, y and z");
    if (property->length_type)
        mesh_error_at_line(source, property->line,
                           "property " + in_quotes(name) + " is a list; it must be one number");
    return property;
}

const PlyProperty* corners_property(const MeshSource& source, const PlyElement& face)
{
    const PlyProperty* plural = property_named(source, face, "vertex_indices");
    const PlyProperty* singular = property_named(source, face, "vertex_index");
    if (plural && singular)
        mesh_error_at_line(source, face.line,
                           "element 'face' has both 'vertex_indices' and 'vertex_index'; keep one");
    const PlyProperty* corners = plural ? plural : singular;
    if (!corners)
        mesh_error_at_line(source, face.line,
                           "element 'face' has no list 'vertex_indices'; triangles need one");
    if (!corners->length_type || !is_integer(corners->type))
        mesh_error_at_line(
            source, corners->line,
            "property " + in_quotes(corners->name) + " must be a list of an integer type such as int");
    return corners;
}

PlyLayout layout_of(const MeshSource& source, const PlyHeader& header)
{
    PlyLayout layout;
    layout.vertex = element_named(source, header, "vertex");
    if (!layout.vertex || layout.vertex->count == 0)
        mesh_error(source, "the mesh has no vertices; export it again");
    // The index 2^32 - 1 is reserved as a marker.
    if (layout.vertex->count >= std::numeric_limits<std::uint32_t>::max())
        mesh_error_at_line(
            source, layout.vertex->line,
            std::to_string(layout.vertex->count) + " vertices are more than the 4294967294 of a mesh");
    for (std::size_t axis = 0; axis < 3; ++axis)
        layout.coordinates[axis] = coordinate_property(source, *layout.vertex, coordinate_names[axis]);

    const PlyElement* strips = element_named(source, header, "tristrips");
    if (strips && strips->count > 0)
        mesh_error_at_line(
            source, strips->line,
            "the triangles are stored as strips (element 'tristrips'); save them as element 'face'");
    layout.face = element_named(source, header, "face");
    if (layout.face && layout.face->count > 0) layout.corners = corners_property(source, *layout.face);
    return layout;
}

template <class Rows>
std::vector<Vec3> read_vertices(Rows& rows, const PlyLayout& layout)
{
    const PlyElement& element = *layout.vertex;
    std::vector<Vec3> vertices;
    vertices.reserve(static_cast<std::size_t>(element.count));  // the file is large enough: checked before
    for (std::uint64_t row = 0; row < element.count; ++row) {
        rows.begin(element, row);
        Vec3 vertex;
        for (const PlyProperty& property : element.properties) {
            if (&property == layout.coordinates[0])
                vertex.x = rows.coordinate(property);
            else if (&property == layout.coordinates[1])
                vertex.y = rows.coordinate(property);
            else if (&property == layout.coordinates[2])
                vertex.z = rows.coordinate(property);
            else
                rows.skip(property);
        }
        rows.end();
        vertices.push_back(vertex);
    }
    return vertices;
}

template <class Rows>
void read_corners(Rows& rows, const PlyProperty& property, std::uint64_t vertex_count, Polygons& faces)
{
    const std::uint64_t corner_count = rows.list_length(property);
    if (corner_count < 3)
        rows.fail(rows.name().text() + " has " + std::to_string(corner_count) +
                  " corners; remove it, a face needs at least 3");
    for (std::uint64_t i = 0; i < corner_count; ++i) {
        const std::int64_t index = rows.integer(property);
        if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count)
            rows.fail(rows.name().text() + " uses vertex " + std::to_string(index) +
                      ", but the vertices are 0 to " + std::to_string(vertex_count - 1) +
                      "; correct the index");
        faces.corners.push_back(static_cast<std::uint32_t>(index));
    }
    faces.ends.push_back(faces.corners.size());
}

template <class Rows>
Polygons read_faces(Rows& rows, const PlyLayout& layout)
{
    Polygons faces;
    for (std::uint64_t row = 0; row < layout.face->count; ++row) {
        rows.begin(*layout.face, row);
        for (const PlyProperty& property : layout.face->properties) {
            if (&property == layout.corners)
                read_corners(rows, property, layout.vertex->count, faces);
            else
                rows.skip(property);
        }
        rows.end();
    }
    return faces;
}

template <class Rows>
void skip_rows(Rows& rows, const PlyElement& element)
{
    for (std::uint64_t row = 0; row < element.count; ++row) {
        rows.begin(element, row);
        for (const PlyProperty& property : element.properties) rows.skip(property);
        rows.end();
    }
}

template <class Rows>
SurfaceMesh read_body(const MeshSource& source, const PlyHeader& header, const PlyLayout& layout, Rows rows)
{
    SurfaceMesh mesh;
    Polygons faces;
    for (const PlyElement& element : header.elements) {
        if (element.count == 0 || element.properties.empty()) continue;  // rows without values take no bytes
        rows.check_room(element);
        if (&element == layout.vertex)
            mesh.vertices = read_vertices(rows, layout);
        else if (&element == layout.face)
            faces = read_faces(rows, layout);
        else
            skip_rows(rows, element);
    }
    // Data after the last row is ignored: several programs append to PLY files.

    mesh.triangles.reserve(faces.corners.size() - 2 * faces.count());
    for (std::size_t i = 0; i < faces.count(); ++i)  // only now, since faces may precede the vertices
        if (!append_triangles(faces.polygon(i), mesh.vertices, mesh.triangles))
            mesh_error(source, "face " + std::to_string(i) + " has " +
                                   std::to_string(faces.polygon(i).size()) +
                                   " corners and is not convex; triangulate the mesh first: the limit is " +
                                   std::to_string(concave_corner_limit) + " corners");
    return mesh;
}

template <class Rows>
std::vector<float> read_attribute(const PlyHeader& header, const PlyElement& vertex,
                                  const PlyProperty& wanted, Rows rows)
{
    std::vector<float> values;
    for (const PlyElement& element : header.elements) {
        if (element.count == 0 || element.properties.empty()) continue;
        rows.check_room(element);
        if (&element != &vertex) {
            skip_rows(rows, element);
            continue;
        }
        for (std::uint64_t row = 0; row < element.count; ++row) {
            rows.begin(element, row);
            for (const PlyProperty& property : element.properties)
                if (&property == &wanted)
                    values.push_back(rows.coordinate(property));
                else
                    rows.skip(property);
            rows.end();
        }
        break;
    }
    return values;
}

}  // namespace

std::vector<float> read_ply_attribute(const MeshSource& source, const std::string& name)
{
    const PlyHeader header = read_ply_header(source);
    const PlyElement& vertex = *layout_of(source, header).vertex;
    const PlyProperty* wanted = property_named(source, vertex, name);
    if (!wanted || wanted->length_type)
        mesh_error_at_line(source, vertex.line,
                           "element 'vertex' has no property " + in_quotes(name) + " that is one number");
    if (header.encoding == PlyEncoding::ascii)
        return read_attribute(header, vertex, *wanted, PlyTextRows(source, header));
    return read_attribute(header, vertex, *wanted, PlyBinaryRows(source, header));
}

SurfaceMesh read_ply(const MeshSource& source)
{
    const PlyHeader header = read_ply_header(source);
    const PlyLayout layout = layout_of(source, header);
    if (header.encoding == PlyEncoding::ascii)
        return read_body(source, header, layout, PlyTextRows(source, header));
    return read_body(source, header, layout, PlyBinaryRows(source, header));
}

}  // namespace pliant
