// Stiffness, damping and limits of a cloth's springs by class, and how stiff limits that remember have to be.
#pragma once

#include <array>

#include "body/spring_set.hpp"
#include "body/stepping_plan.hpp"

namespace pliant {

/// Constant over a run, except for what Simulation changes per frame (the length of a step).
struct ClothParameters {
    std::array<double, spring_class_count> stiffness{};       ///< N/m
    std::array<double, spring_class_count> spring_damping{};  ///< N s/m
    Vec3d gravity;                                            ///< m/s2
    Vec3d wind;                                               ///< m/s
    double air_density = 0;                                   ///< kg/m3
    double drag = 0, lift = 0;
    double damping = 0;    ///< 1/s
    double thickness = 0;  ///< m
    friend bool operator==(const ClothParameters&, const ClothParameters&) = default;
};

/// A class of springs in the constraint methods: as LimitCurve of laws/limit.law.glsl.
struct LimitedSprings {
    bool exists = false;
    double below = 0;  ///< N/m
    double limit = 0;
    double beyond = 0;      ///< N/m
    double compressed = 0;  ///< N/m

    /// LimitCurve::kind of laws/limit.law.glsl.
    int curve_kind() const
    {
        if (beyond == 0 && compressed == 0) return 1;
        return below == 0 && limit == 0 && compressed == 0 ? 2 : 0;
    }
};

/// Limits by class, of the constraint methods. `finish` sets what depends on the whole cloth.
struct SpringLimits {
    std::array<LimitedSprings, spring_class_count> of_class;

    /// The softest limits, in m n^2 / dt^2, that pass a pull through all n springs across the cloth within
    /// one step, if colliders hold it up (docs/physics.md, "Constraints").
    static constexpr double firm_limit = 18.4;
    /// The factor on the stiffness of limits between a mesh's node and a pin. They alone bear what hangs
    /// there, and a jerk stretches them by the change of force over their stiffness.
    static constexpr double held_limit = 4;

    void finish(const SteppingPlan& plan, const SpringSet& springs, double mean_mass, Vec3d gravity);

    const LimitedSprings& of(SpringClass spring_class) const
    {
        return of_class[static_cast<std::size_t>(spring_class)];
    }
    /// Whether limits of a class keep their forces from step to step: see renewed_limit in
    /// laws/limit.law.glsl.
    bool remembers(SpringClass spring_class) const;
    bool remembers_any() const { return remembers(SpringClass::structural) || remembers(SpringClass::shear); }
    /// Whether all springs whose strain is measured are such limits, and softer than their compliance in
    /// steps of `step_length` s; and the largest limit.
    bool does_not_stretch(double step_length) const;
    double largest() const;
    /// Whether bend springs are constraints: too stiff to be folded onto others in the operator.
    bool bends_by_constraints() const
    {
        return constrain_ && of(SpringClass::bend).exists && of(SpringClass::bend).beyond > 0;
    }

    /// N/m: the softest stiffness by which a limit that remembers is made right, in steps of so many seconds;
    /// of springs of a class, with their compliance; and of those that hold a node of a mesh, with theirs.
    double softest(double step_length) const;
    double softest(SpringClass spring_class, double step_length) const
    {
        const double softest_of_all = softest(step_length);
        return softest_of_all / (1 + softest_of_all / of(spring_class).beyond);
    }
    double softest_held(double step_length) const
    {
        const double softest_of_all = held_limit * softest(step_length);
        return softest_of_all / (1 + softest_of_all / of(SpringClass::structural).beyond);
    }
    /// m: maximum displacement by a polish where only inertia resists (newton_polish). On a mesh 1/25 of a
    /// spring's length, which is a strain of 0.08 %, or 0.3 % if both its nodes move; unlimited on sheets.
    double polish_reach() const { return on_grid_ ? 1e9 : 0.04 * length_across_ / across_; }
    /// The part of its stiffness that a slack limit with memory keeps in Newton's matrix. On a mesh half of
    /// the limits are slack, and would hold up falling nodes; on a sheet less than 1 takes more iterations.
    double kept_when_slack() const { return on_grid_ ? 1 : 0.3; }

private:
    bool constrain_ = false;  ///< the method is constraint
    bool remember_ = false;   ///< by multipliers
    bool on_grid_ = false;
    double firm_ = 0, mean_mass_ = 0, across_ = 1, length_across_ = 1;  ///< of m n^2 / dt^2; kg; springs; m
    double gravity_ = 0;                                                ///< m/s2
};

/// Sets stiffness, damping and limits of each class, as the scene has them.
void set_springs(const Cloth& cloth, const SteppingPlan& plan, ClothParameters& parameters,
                 SpringLimits& limits);

}  // namespace pliant
