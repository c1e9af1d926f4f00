// A camera that turns about a point: what the mouse moves.
#pragma once

#include "pliant/scene.hpp"
#include "render/matrix.hpp"

namespace pliant::tool {

/// From the eye through a pixel.
struct Ray {
    Vec3d origin;     ///< m
    Vec3d direction;  ///< unit length
};

class OrbitCamera {
public:
    OrbitCamera() = default;
    explicit OrbitCamera(const Camera& camera);

    Camera camera() const;
    Vec3d centre() const { return centre_; }
    double distance() const { return distance_; }

    /// By pixels of the mouse in a picture of this height.
    void orbit(double dx, double dy, double height);
    void pan(double dx, double dy, double height);
    /// Notches of the wheel: towards the centre when positive.
    void dolly(double notches);
    void look_at(Vec3d centre);
    /// So that a ball fits into the picture, from the same side.
    void frame(Vec3d centre, double radius, double width_by_height);

    Ray ray(double x, double y, double width, double height) const;

private:
    Vec3d eye() const;

    Vec3d centre_;
    double distance_ = 3, yaw_ = 0, pitch_ = 0.3;  ///< m, radians
    Camera rest_;                                  ///< field of view, and what else a camera has
};

/// Where a point is seen, in pixels from the upper left; z: its distance along the view, below 0 behind the
/// eye.
Vec3d seen_at(const Matrix4& clip, Vec3d point, double width, double height);

}  // namespace pliant::tool
