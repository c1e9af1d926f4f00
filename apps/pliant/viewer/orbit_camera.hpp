// A camera that orbits a point, controlled by the mouse.
#pragma once

#include "pliant/scene.hpp"
#include "render/matrix.hpp"

namespace pliant::tool {

/// A ray from the eye through a pixel.
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

    /// Orbits by a mouse movement in pixels, in a picture of this height.
    void orbit(double dx, double dy, double height);
    void pan(double dx, double dy, double height);
    /// `notches` of the wheel; positive moves towards the centre.
    void dolly(double notches);
    void look_at(Vec3d centre);
    /// Moves so that a ball fits into the picture, keeping the direction.
    void frame(Vec3d centre, double radius, double width_by_height);

    Ray ray(double x, double y, double width, double height) const;

private:
    Vec3d eye() const;

    Vec3d centre_;
    double distance_ = 3, yaw_ = 0, pitch_ = 0.3;  ///< m, radians
    Camera rest_;                                  ///< field of view, and the other parameters of a camera
};

/// The position of a point in the picture, in pixels from the upper left; z: its distance along the view,
/// negative behind the eye.
Vec3d seen_at(const Matrix4& clip, Vec3d point, double width, double height);

}  // namespace pliant::tool
