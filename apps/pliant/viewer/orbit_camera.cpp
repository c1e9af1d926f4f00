#include "viewer/orbit_camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/stage.hpp"

namespace pliant::tool {
namespace {

constexpr double steepest = 1.55;  // radians: just below vertical, where "up" is undefined

}  // namespace

OrbitCamera::OrbitCamera(const Camera& camera) : centre_(camera.target), rest_(camera)
{
    const Vec3d back = camera.position - camera.target;
    distance_ = std::max(length(back), 1e-3);
    yaw_ = std::atan2(back.x, back.z);
    pitch_ = std::clamp(std::asin(std::clamp(back.y / distance_, -1.0, 1.0)), -steepest, steepest);
}

Vec3d OrbitCamera::eye() const
{
    const double flat = std::cos(pitch_) * distance_;
    return centre_ + Vec3d{std::sin(yaw_) * flat, std::sin(pitch_) * distance_, std::cos(yaw_) * flat};
}

Camera OrbitCamera::camera() const
{
    Camera camera = rest_;
    camera.position = eye();
    camera.target = centre_;
    return camera;
}

void OrbitCamera::orbit(double dx, double dy, double height)
{
    yaw_ -= dx / height * std::numbers::pi;
    pitch_ = std::clamp(pitch_ + dy / height * std::numbers::pi, -steepest, steepest);
}

void OrbitCamera::pan(double dx, double dy, double height)
{
    // The size of a pixel at the distance of the centre.
    const double pixel =
        2 * distance_ * std::tan(rest_.field_of_view * std::numbers::pi / 360) / std::max(height, 1.0);
    const Vec3d back = normalized(eye() - centre_, {0, 0, 1});
    const Vec3d right = normalized(cross({0, 1, 0}, back), {1, 0, 0}), up = cross(back, right);
    centre_ = centre_ - right * (dx * pixel) + up * (dy * pixel);
}

void OrbitCamera::dolly(double notches)
{
    distance_ = std::clamp(distance_ * std::pow(0.9, notches), 1e-3, 1e5);
}

void OrbitCamera::look_at(Vec3d centre) { centre_ = centre; }

void OrbitCamera::frame(Vec3d centre, double radius, double width_by_height)
{
    const double half = rest_.field_of_view * std::numbers::pi / 360;
    const double narrow = std::atan(std::tan(half) * std::min(1.0, width_by_height));
    centre_ = centre;
    distance_ = std::max(1.1 * radius / std::sin(narrow), 1e-3);
}

Ray OrbitCamera::ray(double x, double y, double width, double height) const
{
    const double half = std::tan(rest_.field_of_view * std::numbers::pi / 360);
    const Vec3d from = eye(), back = normalized(from - centre_, {0, 0, 1});
    const Vec3d right = normalized(cross({0, 1, 0}, back), {1, 0, 0}), up = cross(back, right);
    const double across = (2 * x / width - 1) * half * width / height, upwards = (1 - 2 * y / height) * half;
    return {from, normalized(right * across + up * upwards - back, {0, 0, -1})};
}

Vec3d seen_at(const Matrix4& clip, Vec3d point, double width, double height)
{
    const auto at = clip * to_point(point);
    if (at[3] <= 0) return {0, 0, -1};
    return {(at[0] / at[3] + 1) / 2 * width, (at[1] / at[3] + 1) / 2 * height, at[3]};
}

}  // namespace pliant::tool
