// The meshes that colliders are drawn with lie on the colliders.
#include <gtest/gtest.h>

#include "render/shapes.hpp"
#include "solve/step_constants.hpp"

namespace pliant {
namespace {

TEST(ShapeMeshes, CornersOfATaperedCapsuleLieOnIt)
{
    const ShapeMeshes meshes = make_shape_meshes();
    const PlacedCollider placed = placed_at(
        TaperedCapsule{.start = {0, 0, 0}, .end = {0.3, 0.4, 0.5}, .start_radius = 0.4, .end_radius = 0.15},
        0);
    const ShapePlacement placement = placement_of(placed, 0);
    const auto collider = make_collider<double>(placed);
    const auto range = mesh_of(placed, meshes);
    for (std::uint32_t i = 0; i < range.index_count; ++i) {
        const Vec3d p = placed_corner(placement, meshes.vertices[meshes.indices[range.first_index + i]]);
        EXPECT_NEAR(Laws<double>::collider_gap(collider, {p.x, p.y, p.z}).w, 0, 1e-6);  // rounding of floats
    }
}

}  // namespace
}  // namespace pliant
