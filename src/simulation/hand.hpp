// The hand that pulls at a node: what Simulation::grab keeps.
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
    double step = 0;                    ///< s, that the node's mass is made for now; 0: it has its own

    /// m' of `grabbed_velocity`, in laws/integration.law.glsl.
    double mass_in(double step_length) const
    {
        return mass + step_length * (damping + step_length * stiffness);
    }
    /// The same in an implicit step of second order, which makes m' (1 + d s) of a mass m', for the air: what
    /// the hand adds is no more in air. s: ClothModel::implicit_step.
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
    /// What the pass grab needs in a step of a cloth in air that takes `air_damping` (1/s) of velocities. The
    /// pull is given as velocity, of which the step then takes that part, so it is given that much more: else
    /// what hangs from the hand would seem to weigh more than it does.
    GrabInput input(double step_length, double air_damping) const
    {
        const double decay = 1 - air_damping * step_length;
        const double inverse = decay > 0 ? 1 / (decay * mass_in(step_length)) : 0;
        return {model, node, target, stiffness * step_length * inverse,
                step_length * (damping + step_length * stiffness) * inverse};
    }
};

/// Gives a model's node the mass that it has in the hand, or its own; true when that is another than before.
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

/// What the hand does in a step of its model.
inline GrabInput grab_input(const ClothModel& model, const Hand& hand, double step_length)
{
    const double air = model.parameters.damping;
    return model.plan.is_second_order() ? hand.implicit_input(model.plan.implicit_step(step_length), air)
                                        : hand.input(step_length, air);
}

}  // namespace pliant
