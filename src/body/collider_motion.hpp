// Place and velocity of a collider at a time: keyframes converted to rigid motion.
#pragma once

#include <array>
#include <type_traits>
#include <variant>
#include <vector>

#include "pliant/api.hpp"
#include "pliant/scene.hpp"

namespace pliant {

/// The images of the unit vectors x, y and z: a rotation matrix by columns.
using Rotation = std::array<Vec3d, 3>;

/// R = Rz(degrees.z) Ry(degrees.y) Rx(degrees.x): about x, then y, then z.
PLIANT_INSIDE Rotation rotation_from_degrees(Vec3d degrees);
PLIANT_INSIDE Vec3d rotate(const Rotation& rotation, Vec3d vector);
Rotation compose(const Rotation& outer, const Rotation& inner);

/// A rigid motion relative to the collider's initial place.
struct RigidMotion {
    Vec3d offset;       ///< m
    Rotation rotation;  ///< about the collider's centre
    Vec3d velocity;     ///< m/s
    Vec3d spin;         ///< rad/s
};

/// Interpolates linearly between keyframes (positions, and the three angles, so that 0 to 360 is a full
/// turn); constant before the first and after the last.
RigidMotion motion_at(const std::vector<Keyframe>& keyframes, double time);

/// The index of a shape in the variant Collider.
template <class Shape>
inline constexpr std::size_t shape_number = []<class... Shapes>(std::type_identity<std::variant<Shapes...>>) {
    std::size_t number = 0;
    (void)((std::is_same_v<Shape, Shapes> || (++number, false)) || ...);
    return number;
}(std::type_identity<Collider>{});

/// The shape of a collider at a time, in the world.
struct PlacedCollider {
    std::size_t shape = 0;  ///< index in Collider; contact.law.glsl uses the same numbers
    Vec3d centre;           ///< m; of a plane: its point
    Rotation axes{Vec3d{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< of a box; a plane's normal and a capsule's axis
                                                          ///< are axes[1]
    Vec3d half_size;    ///< m, of a box; of a capsule, y is half the distance between its ends
    double radius = 0;  ///< m; of sphere and capsule
    double friction = 0;
    ContactResponse response = ContactResponse::coulomb;
    Vec3d velocity;          ///< m/s, of the centre
    Vec3d spin;              ///< rad/s
    bool moves = false;      ///< has keyframes
    bool lets_rise = false;  ///< nodes inside it rise slowly to its surface

    template <class Shape>
    bool is() const
    {
        return shape == shape_number<Shape>;
    }
};
PLIANT_INSIDE PlacedCollider placed_at(const Collider& collider, double time);

}  // namespace pliant
