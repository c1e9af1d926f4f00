// Where a picture can differ from one of the empty stage: around cloths, colliders and their shadows.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "render/shapes.hpp"
#include "render/stage.hpp"

namespace pliant {

/// A rectangle of pixels, with its lower ends and without its upper ones.
struct PixelArea {
    std::uint32_t left = 0, top = 0, right = 0, bottom = 0;

    bool empty() const { return left >= right || top >= bottom; }
    std::uint32_t width() const { return right - left; }
    std::uint32_t height() const { return bottom - top; }
    friend bool operator==(const PixelArea&, const PixelArea&) = default;
};
/// The smallest that has both.
PixelArea united(const PixelArea& a, const PixelArea& b);

/// Gathers what stands on a stage, as seen by a camera.
class TouchedArea {
public:
    /// `colliders` at the time of the picture: the floors among them catch shadows, the others are included,
    /// as they are drawn with `meshes`.
    TouchedArea(const Stage& stage, const Camera& camera, std::uint32_t width, std::uint32_t height,
                double shadow_texel, std::span<const PlacedCollider> colliders, const ShapeMeshes& meshes);

    /// The corners of triangles, m.
    void include(std::span<const Vec3> points);

    /// None where that cannot be told: something reaches behind the camera, is not finite, or is a floor that
    /// moves.
    std::optional<PixelArea> area() const;

private:
    void include(const PlacedCollider& collider, const ShapeMeshes& meshes);
    void include(Vec3d point);

    double width_, height_;       // pixels
    double inset_;                // m
    double nearest_;              // m, before the camera: what is nearer cannot be told
    double blur_;                 // pixels at 1 m, how far the edge of a shadow may reach
    std::vector<Matrix4> views_;  // of the thing itself, and of its shadow on each floor
    double left_ = 1e30, top_ = 1e30, right_ = -1e30, bottom_ = -1e30;  // pixels
    bool unknown_ = false;
};

}  // namespace pliant
