// The stage of a scene: the space of cloth and colliders, the floor, the sun, and the camera.
#pragma once

#include <array>

#include "pliant/scene.hpp"
#include "render/matrix.hpp"
#include "render/shapes.hpp"

namespace pliant {

/// An axis-aligned box, initially empty.
struct Bounds {
    Vec3d min{1e30, 1e30, 1e30}, max{-1e30, -1e30, -1e30};  ///< m

    bool empty() const { return min.x > max.x; }
    void include(Vec3d point, double radius = 0);
    void clip(const Bounds& other);
};

/// Fixed for the whole run, so that light and shadows do not shimmer.
struct Stage {
    Vec3d to_light;                ///< unit length
    Matrix4 shadow_from_world{1};  ///< xy onto [0, 1] of the shadow map, z its depth
    double shadow_extent = 1;      ///< m, edge of the square that the shadow map covers
    double floor_height = 0;       ///< m, of the floor that is drawn if the scene has no plane
    bool has_plane = false;        ///< if so, that floor is not drawn
    Vec3d centre;                  ///< m, target of the camera
    double view_distance = 1;      ///< m, from the camera to it
    double inset = 0;              ///< m, see placement_of
};
Stage make_stage(const Scene& scene);

/// A floor at a height, centred at the camera's target.
GroundPlacement ground_at(const Stage& stage, double height, bool collider);

/// `Frame` in shaders/frame.glsl, in the layout std140.
struct FrameUniforms {
    std::array<float, 16> clip_from_world;
    std::array<float, 16> shadow_from_world;
    std::array<float, 4> eye;
    std::array<float, 4> to_light;
    std::array<float, 4> picture;
    float shadow_texel;
    float value_low, value_high;
    float blend;
    std::uint32_t colours;
    float padding[3];
};
/// Camera, light and size; defaults for the rest: checker, and the current state only.
FrameUniforms frame_uniforms(const Stage& stage, const Camera& camera, std::uint32_t width,
                             std::uint32_t height, std::uint32_t shadow_map_size);

/// From the world to Vulkan's clip space.
Matrix4 clip_from_world(const Camera& camera, double width_by_height);

}  // namespace pliant
