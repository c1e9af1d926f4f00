// The meshes of colliders, and their placement.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "body/collider_motion.hpp"
#include "render/surface_edges.hpp"

namespace pliant {

/// A corner of a unit mesh; `corner` and `corner_normal` in shaders/shape.glsl.
struct ShapeVertex {
    std::array<float, 3> position;
    float half;  ///< -1 or 1: the direction in which elongation moves it along y
    std::array<float, 3> normal;
};

/// Flag in the last number of an edge: a crease, drawn even where it is no outline.
constexpr std::uint32_t sharp_edge = 1u << 31;

/// All unit meshes in one vertex and one index list.
struct ShapeMeshes {
    struct Range {
        std::uint32_t first_index = 0, index_count = 0, first_edge = 0, edge_count = 0;
    };
    std::vector<ShapeVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<SurfaceEdge> edges;  ///< by the first vertex at each position; see sharp_edge
    Range round;                     ///< sphere of radius 1, cut at the equator: also a capsule
    Range cube;                      ///< [-1, 1]^3
};
ShapeMeshes make_shape_meshes();

/// The two halves of a round shape: their radii, and the angle, as a sine, by which the seam between them is
/// moved towards the upper pole. A cone tangent to two spheres of different radii does not touch them at
/// their equators.
struct ShapeEnds {
    float upper = 1, lower = 1, tilt = 0, unused = 0;
};

/// The push constants of shaders/shape.glsl.
struct ShapePlacement {
    std::array<std::array<float, 4>, 3> axes;
    std::array<float, 4> size;
    ShapeEnds ends;
    std::array<float, 4> colour;
};

/// The push constants of shaders/ground.glsl.
struct GroundPlacement {
    std::array<float, 4> place;
    float spacing;   ///< m between grid lines
    float strength;  ///< 1 for a collider, less for a floor that only receives the shadow
};

/// How to draw a collider. Round shapes are drawn smaller by `inset` (m), since the flat triangles of a cloth
/// on them cut through the arcs.
ShapePlacement placement_of(const PlacedCollider& collider, double inset);
ShapeMeshes::Range mesh_of(const PlacedCollider& collider, const ShapeMeshes& meshes);
/// m: where a vertex of its mesh is drawn.
Vec3d placed_corner(const ShapePlacement& placement, const ShapeVertex& corner);

struct Ball {
    Vec3d centre;       ///< m
    double radius = 0;  ///< m
};
/// Two balls whose convex hull encloses a collider; undefined for a plane.
std::array<Ball, 2> balls_around(const PlacedCollider& collider);

/// Whether it is a horizontal plane that faces up.
bool is_ground(const PlacedCollider& collider);

}  // namespace pliant
