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
    const double mass = step_length > 0 ? hand.mass_in(step_length) : hand.mass;
    model.masses[hand.node] = mass;
    return true;
}

}  // namespace pliant
