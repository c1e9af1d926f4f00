// The area in which a picture can differ from the empty stage: cloths, colliders and their shadows.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "render/shapes.hpp"
#include "render/stage.hpp"

namespace pliant {

/// A rectangle of pixels; lower bounds inclusive, upper bounds exclusive.
struct PixelArea {
    std::uint32_t left = 0, top = 0, right = 0, bottom = 0;

    bool empty() const { return left >= right || top >= bottom; }
    std::uint32_t width() const { return right - left; }
    std::uint32_t height() const { return bottom - top; }
    friend bool operator==(const PixelArea&, const PixelArea&) = default;
};
/// The smallest area that contains both.
PixelArea united(const PixelArea& a, const PixelArea& b);

/// Accumulates the projections of objects on a stage.
class TouchedArea {
public:
    /// `colliders`: at the time of the picture. Floors among them receive shadows; the others are included,
    /// with their `meshes`.
    TouchedArea(const Stage& stage, const Camera& camera, std::uint32_t width, std::uint32_t height,
                double shadow_texel, std::span<const PlacedCollider> colliders, const ShapeMeshes& meshes);

    /// Adds corners of triangles, m.
    void include(std::span<const Vec3> points);

    /// Empty if it cannot be determined: an object extends behind the camera, is not finite, or is a moving
    /// floor.
    std::optional<PixelArea> area() const;

private:
    void include(const PlacedCollider& collider, const ShapeMeshes& meshes);
    void include(Vec3d point);

    double width_, height_;       // pixels
    double inset_;                // m
    double nearest_;              // m in front of the camera: anything nearer cannot be bounded
    double blur_;                 // pixels at 1 m, the blur of a shadow's edge
    std::vector<Matrix4> views_;  // of the object itself, and of its shadow on each floor
    double left_ = 1e30, top_ = 1e30, right_ = -1e30, bottom_ = -1e30;  // pixels
    bool unknown_ = false;
};

}  // namespace pliant
