#include "body/collider_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pliant {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;

Rotation about_x(double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return {Vec3d{1, 0, 0}, {0, c, s}, {0, -s, c}};
}
Rotation about_y(double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return {Vec3d{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
}
Rotation about_z(double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return {Vec3d{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
}

/// A rotation that maps y to `direction`.
Rotation frame_with_y(Vec3d direction)
{
    const double length = std::sqrt(dot(direction, direction));
    const Vec3d y = length > 0 ? direction * (1 / length) : Vec3d{0, 1, 0};
    const Vec3d helper = std::abs(y.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 0, 1};
    Vec3d z = cross(helper, y);
    z = z * (1 / std::sqrt(dot(z, z)));
    return {cross(y, z), y, z};
}

// Place and size of a shape before it moves.
void put(PlacedCollider& placed, const Sphere& sphere)
{
    placed.centre = sphere.centre;
    placed.radius = sphere.radius;
}
void put(PlacedCollider& placed, const Plane& plane)
{
    placed.centre = plane.point;
    placed.axes = frame_with_y(plane.normal);
}
void put(PlacedCollider& placed, const Box& box)
{
    placed.centre = box.centre;
    placed.axes = rotation_from_degrees(box.rotation);
    placed.half_size = box.size * 0.5;
}
void put(PlacedCollider& placed, const Capsule& capsule)
{
    const Vec3d axis = (capsule.end - capsule.start) * 0.5;
    placed.centre = (capsule.start + capsule.end) * 0.5;
    placed.axes = frame_with_y(axis);
    placed.half_size.y = std::sqrt(dot(axis, axis));
    placed.radius = capsule.radius;
}
void put(PlacedCollider& placed, const TaperedCapsule& capsule)
{
    const Vec3d axis = (capsule.end - capsule.start) * 0.5;
    const double half_length = std::sqrt(dot(axis, axis));
    const double more = (capsule.end_radius - capsule.start_radius) * 0.5;
    placed.axes = frame_with_y(axis);
    if (std::abs(more) >= half_length) {  // one sphere contains the other
        placed.centre = more > 0 ? capsule.end : capsule.start;
        placed.radius = std::max(capsule.start_radius, capsule.end_radius);
        return;
    }
    const double growth = more / half_length;  // of the radius along the axis; see gap_tapered_capsule
    placed.centre = (capsule.start + capsule.end) * 0.5;
    placed.half_size = {growth / std::sqrt(1 - growth * growth), half_length, growth};
    placed.radius = (capsule.start_radius + capsule.end_radius) * 0.5;
}

}  // namespace

Rotation rotation_from_degrees(Vec3d degrees)
{
    return compose(about_z(degrees.z * radians_per_degree),
                   compose(about_y(degrees.y * radians_per_degree), about_x(degrees.x * radians_per_degree)));
}

Vec3d rotate(const Rotation& rotation, Vec3d vector)
{
    return rotation[0] * vector.x + rotation[1] * vector.y + rotation[2] * vector.z;
}

Rotation compose(const Rotation& outer, const Rotation& inner)
{
    return {rotate(outer, inner[0]), rotate(outer, inner[1]), rotate(outer, inner[2])};
}

RigidMotion motion_at(const std::vector<Keyframe>& keyframes, double time)
{
    if (keyframes.empty()) return {{}, rotation_from_degrees({}), {}, {}};
    if (time < keyframes.front().time)
        return {keyframes.front().position, rotation_from_degrees(keyframes.front().rotation), {}, {}};
    if (time >= keyframes.back().time)
        return {keyframes.back().position, rotation_from_degrees(keyframes.back().rotation), {}, {}};

    const auto after = std::upper_bound(keyframes.begin(), keyframes.end(), time,
                                        [](double t, const Keyframe& keyframe) { return t < keyframe.time; });
    const Keyframe& a = *(after - 1);
    const Keyframe& b = *after;
    const double span = b.time - a.time, s = (time - a.time) / span;
    const Vec3d degrees = a.rotation + (b.rotation - a.rotation) * s;
    const Vec3d rate = (b.rotation - a.rotation) * (radians_per_degree / span);  // rad/s of each angle
    // w = rate_z z + Rz (rate_y y) + Rz Ry (rate_x x), the derivative of Rz Ry Rx
    const Rotation turn_z = about_z(degrees.z * radians_per_degree);
    const Rotation turn_zy = compose(turn_z, about_y(degrees.y * radians_per_degree));
    return {a.position + (b.position - a.position) * s, rotation_from_degrees(degrees),
            (b.position - a.position) * (1 / span),
            Vec3d{0, 0, rate.z} + turn_z[1] * rate.y + turn_zy[0] * rate.x};
}

PlacedCollider placed_at(const Collider& collider, double time)
{
    PlacedCollider placed;
    placed.shape = collider.index();
    std::visit(
        [&](const auto& shape) {
            put(placed, shape);
            const RigidMotion motion = motion_at(shape.keyframes, time);
            placed.centre = placed.centre + motion.offset;
            placed.axes = compose(motion.rotation, placed.axes);
            placed.friction = shape.friction;
            placed.response = shape.response;
            placed.velocity = motion.velocity;
            placed.spin = motion.spin;
            placed.moves = !shape.keyframes.empty();
        },
        collider);
    return placed;
}

}  // namespace pliant
