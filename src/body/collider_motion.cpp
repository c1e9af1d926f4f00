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

/// A rotation that turns y into `direction`.
Rotation frame_with_y(Vec3d direction)
{
    const double length = std::sqrt(dot(direction, direction));
    const Vec3d y = length > 0 ? direction * (1 / length) : Vec3d{0, 1, 0};
    const Vec3d helper = std::abs(y.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 0, 1};
    Vec3d z = cross(helper, y);
    z = z * (1 / std::sqrt(dot(z, z)));
    return {cross(y, z), y, z};
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
    const auto take_common = [&](const auto& shape, Vec3d centre) {
        const RigidMotion motion = motion_at(shape.keyframes, time);
        placed.centre = centre + motion.offset;
        placed.friction = shape.friction;
        placed.response = shape.response;
        placed.velocity = motion.velocity;
        placed.spin = motion.spin;
        placed.moves = !shape.keyframes.empty();
        return motion.rotation;
    };
    using Kind = PlacedCollider::Kind;
    if (const auto* sphere = std::get_if<Sphere>(&collider)) {
        placed.kind = Kind::sphere;
        placed.axes = take_common(*sphere, sphere->centre);
        placed.radius = sphere->radius;
    } else if (const auto* plane = std::get_if<Plane>(&collider)) {
        placed.kind = Kind::plane;
        const Rotation turn = take_common(*plane, plane->point);
        placed.axes = compose(turn, frame_with_y(plane->normal));
    } else if (const auto* box = std::get_if<Box>(&collider)) {
        placed.kind = Kind::box;
        const Rotation turn = take_common(*box, box->centre);
        placed.axes = compose(turn, rotation_from_degrees(box->rotation));
        placed.half_size = box->size * 0.5;
    } else if (const auto* capsule = std::get_if<Capsule>(&collider)) {
        placed.kind = Kind::capsule;
        const Rotation turn = take_common(*capsule, (capsule->start + capsule->end) * 0.5);
        const Vec3d axis = (capsule->end - capsule->start) * 0.5;
        placed.axes = compose(turn, frame_with_y(axis));
        placed.half_size.y = std::sqrt(dot(axis, axis));
        placed.radius = capsule->radius;
    }
    return placed;
}

}  // namespace pliant
