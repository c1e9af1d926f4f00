#include "render/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "render/matrix.hpp"

namespace pliant {
namespace {

// Fine enough that the outline of a sphere half as high as the picture is off by a quarter of a pixel.
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
    // Rows from pole to pole, with the equator twice: the wall of a capsule is between the two.
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

/// Edges between positions. A mesh has several vertices at one position: one for each normal, and for each
/// end of a seam.
std::vector<SurfaceEdge> edges_between_places(const ShapeMeshes& meshes, std::size_t first_index)
{
    std::map<std::array<float, 4>, std::uint32_t> places;
    const auto place_of = [&](std::uint32_t vertex) {
        const auto& [at, half, normal] = meshes.vertices[vertex];
        const auto rounded = [](float x) { return std::round(x * 1e5f) + 0.0f; };  // the sum avoids negative
                                                                                   // zeros
        return places.try_emplace({rounded(at[0]), rounded(at[1]), rounded(at[2]), half}, vertex)
            .first->second;
    };
    std::vector<Triangle> triangles;
    for (std::size_t i = first_index; i < meshes.indices.size(); i += 3) {
        const Triangle t{place_of(meshes.indices[i]), place_of(meshes.indices[i + 1]),
                         place_of(meshes.indices[i + 2])};
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            triangles.push_back(t);  // not the degenerate ones at the poles
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
    const auto drawn_radius = [&](double radius) { return radius - std::min(inset, 0.05 * radius); };
    const double radius = drawn_radius(collider.radius);
    const bool is_plane = collider.is<Plane>();
    // A sphere's rotation is invisible.
    const Rotation axes = collider.is<Sphere>() ? PlacedCollider{}.axes : collider.axes;
    Vec3d scale{1, 1, 1}, centre = collider.centre;
    double apart = 0;
    ShapeEnds ends;
    if (collider.is<Sphere>()) {
        scale = scale * radius;
    } else if (collider.is<Capsule>()) {
        scale = scale * radius;
        apart = collider.half_size.y;
    } else if (collider.is<TaperedCapsule>()) {
        const double growth = collider.half_size.z;
        apart = collider.half_size.y;
        ends = {static_cast<float>(drawn_radius(collider.radius + growth * apart)),
                static_cast<float>(drawn_radius(collider.radius - growth * apart)),
                static_cast<float>(-growth)};
    } else if (collider.is<Box>()) {
        scale = collider.half_size;
    } else if (is_plane) {
        scale = Vec3d{board_edge, board_thickness, board_edge} * 0.5;
        centre = centre - axes[1] * (0.5 * board_thickness);
    }
    const Vec3 x = to_float(axes[0]), y = to_float(axes[1]), z = to_float(axes[2]);
    const Vec3 middle = to_float(centre), size = to_float(scale);
    const std::array<float, 4> porcelain{0.70f, 0.69f, 0.67f, 1.0f}, board{0.36f, 0.39f, 0.42f, 1.0f};
    return {{{{x.x, x.y, x.z, middle.x}, {y.x, y.y, y.z, middle.y}, {z.x, z.y, z.z, middle.z}}},
            {size.x, size.y, size.z, static_cast<float>(apart)},
            ends,
            is_plane ? board : porcelain};
}

// As `placed` in shaders/shape.glsl.
Vec3d placed_corner(const ShapePlacement& placement, const ShapeVertex& corner)
{
    const ShapeEnds& ends = placement.ends;
    Vec3d unit{double{corner.position[0]}, double{corner.position[1]}, double{corner.position[2]}};
    if (ends.tilt != 0.0f) {
        const double y = unit.y + double{ends.tilt} * (1 - std::abs(unit.y));
        const double around = std::hypot(unit.x, unit.z);
        const double wider = around > 0 ? std::sqrt(std::max(0.0, 1 - y * y)) / around : 0;
        unit = {unit.x * wider, y, unit.z * wider};
    }
    const double end = corner.half > 0 ? double{ends.upper} : double{ends.lower};
    const double x = end * unit.x * double{placement.size[0]}, z = end * unit.z * double{placement.size[2]};
    const double y =
        end * unit.y * double{placement.size[1]} + double{corner.half} * double{placement.size[3]};
    const auto& axes = placement.axes;
    const auto part = [&](std::size_t k) {
        return double{axes[0][k]} * x + double{axes[1][k]} * y + double{axes[2][k]} * z;
    };
    return Vec3d{part(0), part(1), part(2)} +
           Vec3d{double{axes[0][3]}, double{axes[1][3]}, double{axes[2][3]}};
}

ShapeMeshes::Range mesh_of(const PlacedCollider& collider, const ShapeMeshes& meshes)
{
    return collider.is<Box>() || collider.is<Plane>() ? meshes.cube : meshes.round;
}

std::array<Ball, 2> balls_around(const PlacedCollider& collider)
{
    const Vec3d arm = collider.is<Box>() ? Vec3d{} : collider.axes[1] * collider.half_size.y;
    const double radius = collider.is<Box>() ? length(collider.half_size) : collider.radius;
    const double more = collider.is<TaperedCapsule>() ? collider.half_size.z * collider.half_size.y : 0;
    return {Ball{collider.centre + arm, radius + more}, Ball{collider.centre - arm, radius - more}};
}

bool is_ground(const PlacedCollider& collider) { return collider.is<Plane>() && collider.axes[1].y > 0.9999; }

}  // namespace pliant
