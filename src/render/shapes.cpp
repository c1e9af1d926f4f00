#include "render/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace pliant {
namespace {

// Fine enough that the outline of a sphere half a picture high is off by a quarter of a pixel.
constexpr std::uint32_t meridians = 64, rings_per_half = 16;
constexpr double board_edge = 3.0, board_thickness = 0.02;  // m, of a plane that is not the ground

void add_quad(ShapeMeshes& meshes, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d)
{
    for (const auto index : {a, b, c, a, c, d}) meshes.indices.push_back(index);
}

std::uint32_t add_vertex(ShapeMeshes& meshes, Vec3d position, float half, Vec3d normal)
{
    const Vec3 p = to_float(position), n = to_float(normal);
    meshes.vertices.push_back({{p.x, p.y, p.z}, half, {n.x, n.y, n.z}});
    return static_cast<std::uint32_t>(meshes.vertices.size() - 1);
}

void add_round(ShapeMeshes& meshes)
{
    // Rows from pole to pole, with the equator twice: between the two lies the wall of a capsule.
    std::uint32_t above = 0;
    for (std::uint32_t row = 0; row <= 2 * rings_per_half + 1; ++row) {
        const bool upper = row <= rings_per_half;
        const double latitude =
            std::numbers::pi * 0.5 * (1.0 - double(upper ? row : row - 1) / rings_per_half);
        const auto first = static_cast<std::uint32_t>(meshes.vertices.size());
        for (std::uint32_t i = 0; i <= meridians; ++i) {
            const double longitude = 2 * std::numbers::pi * i / meridians;
            const Vec3d p{std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                          std::cos(latitude) * std::cos(longitude)};
            add_vertex(meshes, p, upper ? 1.0f : -1.0f, p);
        }
        for (std::uint32_t i = 0; row > 0 && i < meridians; ++i)
            add_quad(meshes, above + i, first + i, first + i + 1, above + i + 1);
        above = first;
    }
}

void add_cube(ShapeMeshes& meshes)
{
    const Vec3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            const Vec3d n = axes[axis] * sign, u = axes[(axis + 1) % 3] * sign, v = axes[(axis + 2) % 3];
            const auto a = add_vertex(meshes, n - u - v, 0, n), b = add_vertex(meshes, n + u - v, 0, n);
            const auto c = add_vertex(meshes, n + u + v, 0, n), d = add_vertex(meshes, n - u + v, 0, n);
            add_quad(meshes, a, b, c, d);
        }
}

/// The edges of triangles between places, of which a mesh has a vertex for each normal and each end of a
/// seam.
std::vector<SurfaceEdge> edges_between_places(const ShapeMeshes& meshes, std::size_t first_index)
{
    std::map<std::array<float, 4>, std::uint32_t> places;
    const auto place_of = [&](std::uint32_t vertex) {
        const auto& [at, half, normal] = meshes.vertices[vertex];
        const auto rounded = [](float x) { return std::round(x * 1e5f) + 0.0f; };  // and no negative zero
        return places.try_emplace({rounded(at[0]), rounded(at[1]), rounded(at[2]), half}, vertex)
            .first->second;
    };
    std::vector<Triangle> triangles;
    for (std::size_t i = first_index; i < meshes.indices.size(); i += 3) {
        const Triangle t{place_of(meshes.indices[i]), place_of(meshes.indices[i + 1]),
                         place_of(meshes.indices[i + 2])};
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);  // not those at the poles
    }
    return edges_of(triangles);
}

ShapeMeshes::Range added_by(void (*add)(ShapeMeshes&), ShapeMeshes& meshes, bool sharp)
{
    const auto first = static_cast<std::uint32_t>(meshes.indices.size());
    const auto first_edge = static_cast<std::uint32_t>(meshes.edges.size());
    add(meshes);
    for (SurfaceEdge edge : edges_between_places(meshes, first)) {
        if (sharp) edge[3] |= sharp_edge;
        meshes.edges.push_back(edge);
    }
    return {first, static_cast<std::uint32_t>(meshes.indices.size()) - first, first_edge,
            static_cast<std::uint32_t>(meshes.edges.size()) - first_edge};
}

}  // namespace

ShapeMeshes make_shape_meshes()
{
    ShapeMeshes meshes;
    meshes.round = added_by(add_round, meshes, false);
    meshes.cube = added_by(add_cube, meshes, true);
    return meshes;
}

ShapePlacement placement_of(const PlacedCollider& collider, double inset)
{
    using Kind = PlacedCollider::Kind;
    Vec3d scale{1, 1, 1}, centre = collider.centre;
    double stretch = 0;
    // A sphere's turning cannot be seen, and its axes need not be set.
    Rotation axes{Vec3d{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (collider.kind != Kind::sphere) axes = collider.axes;
    switch (collider.kind) {
        case Kind::capsule: stretch = collider.half_size.y; [[fallthrough]];
        case Kind::sphere: scale = scale * (collider.radius - std::min(inset, 0.05 * collider.radius)); break;
        case Kind::box: scale = collider.half_size; break;
        case Kind::plane:
            scale = Vec3d{board_edge, board_thickness, board_edge} * 0.5;
            centre = centre - axes[1] * (0.5 * board_thickness);
            break;
    }
    const Vec3 x = to_float(axes[0]), y = to_float(axes[1]), z = to_float(axes[2]);
    const Vec3 middle = to_float(centre), size = to_float(scale);
    const std::array<float, 4> porcelain{0.70f, 0.69f, 0.67f, 1.0f}, board{0.36f, 0.39f, 0.42f, 1.0f};
    return {{{{x.x, x.y, x.z, middle.x}, {y.x, y.y, y.z, middle.y}, {z.x, z.y, z.z, middle.z}}},
            {size.x, size.y, size.z, static_cast<float>(stretch)},
            collider.kind == Kind::plane ? board : porcelain};
}

ShapeMeshes::Range mesh_of(const PlacedCollider& collider, const ShapeMeshes& meshes)
{
    using Kind = PlacedCollider::Kind;
    return collider.kind == Kind::box || collider.kind == Kind::plane ? meshes.cube : meshes.round;
}

bool is_ground(const PlacedCollider& collider)
{
    return collider.kind == PlacedCollider::Kind::plane && collider.axes[1].y > 0.9999;
}

}  // namespace pliant
