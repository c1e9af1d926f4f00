// The hand that pulls a node (Simulation::grab).
#pragma once

#include <optional>

#include "backend/pass_runner.hpp"
#include "body/cloth_model.hpp"

namespace pliant {

struct Hand {
    std::uint32_t model = 0, node = 0;
    Vec3d target = {};                  ///< m, in the model's coordinates
    double stiffness = 0, damping = 0;  ///< N/m, N s/m
    double mass = 0;                    ///< kg, of the node without the hand
    double step = 0;                    ///< s, the step length for which the node's mass is set; 0: its own
                                        ///< mass

    /// m' of `grabbed_velocity` in laws/integration.law.glsl.
    double mass_in(double step_length) const
    {
        return mass + step_length * (damping + step_length * stiffness);
    }
    /// The same for a second-order implicit step. That step multiplies masses by 1 + d s for the air; the
    /// hand's own mass must not grow by it. s: ClothModel::implicit_step.
    double implicit_mass_in(double s, double air_damping) const { return mass + held(s, air_damping); }
    GrabInput implicit_input(double s, double air_damping) const
    {
        const double inverse = 1 / implicit_mass_in(s, air_damping);
        return {model, node, target, stiffness * s * inverse, held(s, air_damping) * inverse};
    }
    double held(double s, double air_damping) const
    {
        return s * (damping + s * stiffness) / (1 + air_damping * s);
    }
    /// Input of the pass grab, for a cloth whose air removes the part `air_damping` (1/s) of velocities. The
    /// pull is given as a velocity and is increased to compensate for that damping; otherwise a load on the
    /// hand would seem heavier than it is.
    GrabInput input(double step_length, double air_damping) const
    {
        const double decay = 1 - air_damping * step_length;
        const double inverse = decay > 0 ? 1 / (decay * mass_in(step_length)) : 0;
        return {model, node, target, stiffness * step_length * inverse,
                step_length * (damping + step_length * stiffness) * inverse};
    }
};

/// Sets the mass of the hand's node for this step length. Returns whether it changed.
inline bool set_mass(ClothModel& model, Hand& hand, double step_length)
{
    if (hand.step == step_length) return false;
    hand.step = step_length;
    const bool two = model.plan.is_second_order();
    const double mass =
        step_length <= 0 ? hand.mass
        : two ? hand.implicit_mass_in(model.plan.implicit_step(step_length), model.parameters.damping)
              : hand.mass_in(step_length);
    model.masses.kg[hand.node] = mass;
    return true;
}

/// The hand's input for one step of its model.
inline GrabInput grab_input(const ClothModel& model, const Hand& hand, double step_length)
{
    const double air = model.parameters.damping;
    return model.plan.is_second_order() ? hand.implicit_input(model.plan.implicit_step(step_length), air)
                                        : hand.input(step_length, air);
}

}  // namespace pliant
