// Constants of a step in a kernel's number type: colliders, forces, a hand.
#pragma once

#include <cstdint>
#include <span>

#include "body/cloth_model.hpp"
#include "body/collider_motion.hpp"
#include "laws/laws.hpp"

namespace pliant {

/// A hand that pulls a node by a spring: parameters of `grabbed_velocity` in laws/integration.law.glsl.
struct GrabInput {
    std::uint32_t cloth = 0, node = 0;
    Vec3d target;               ///< m, in the cloth's coordinates
    double pull = 0, hold = 0;  ///< 1/s, and without unit
};

/// A collider in the coordinates of a cloth with its own origin.
inline PlacedCollider seen_from(PlacedCollider placed, Vec3d origin)
{
    placed.centre = placed.centre - origin;
    return placed;
}

/// A collider in a kernel's number type.
template <class T>
typename Laws<T>::Collider make_collider(const PlacedCollider& placed)
{
    const auto number = [](double a) { return static_cast<T>(a); };
    const auto vector = [&](Vec3d a) { return Vector3<T>{number(a.x), number(a.y), number(a.z)}; };
    typename Laws<T>::Collider collider;
    collider.kind = static_cast<int>(placed.shape);
    const bool lets_rise = placed.lets_rise && placed.response == ContactResponse::coulomb;
    collider.response = lets_rise ? 2 : static_cast<int>(placed.response);
    collider.centre = vector(placed.centre);
    collider.axis_x = vector(placed.axes[0]);
    collider.axis_y = vector(placed.axes[1]);
    collider.axis_z = vector(placed.axes[2]);
    collider.half_size = vector(placed.half_size);
    collider.radius = number(placed.radius);
    collider.friction = number(placed.friction);
    collider.velocity = vector(placed.velocity);
    collider.spin = vector(placed.spin);
    return collider;
}

/// Constants of a step in a kernel's number type.
template <class T>
struct StepConstants {
    T dt{}, decay{}, thickness{};
    Vector3<T> gravity{}, gravity_direction{}, wind{};
    T air_density{}, drag{}, lift{};
    T stiffness[spring_class_count]{}, damping[spring_class_count]{};
    T rest_lengths[5]{};  ///< of a sheet

    T inverse_dt{};  ///< 1/s
    std::span<const VolumeGoal> goals =
        {};  ///< by part of a body; one row for each step of the frame, or one for all

    std::span<const Vec3> attached = {};  ///< m, positions of attached nodes, a row for each step of the
                                          ///< frame

    std::uint32_t grabbed_node = 0;  ///< see GrabInput
    Vector3<T> grab_target{};
    T grab_pull{}, grab_hold{};

    StepConstants(const ClothModel& model, double step_length);
    void set(const GrabInput& grab);
};

extern template struct StepConstants<double>;
extern template struct StepConstants<float>;

}  // namespace pliant
