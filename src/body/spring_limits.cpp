#include "body/spring_limits.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {

void set_springs(const Cloth& cloth, const SteppingPlan& plan, ClothParameters& parameters,
                 SpringLimits& limits)
{
    const bool implicit = plan.integrator == Integrator::implicit_euler;
    SpringParameters classes[] = {cloth.springs.structural, cloth.springs.shear, cloth.springs.bend};
    if (cloth.body) {
        classes[1] = {cloth.body->internal.stiffness, cloth.body->internal.damping};
        classes[2] = {};
    }
    for (std::size_t k = 0; k < spring_class_count; ++k) {
        const SpringParameters& given = classes[k];
        SpringRole role = given.role;
        if (role == SpringRole::automatic)
            role = plan.method == Method::constraint && !implicit &&
                           k != static_cast<std::size_t>(SpringClass::bend)
                       ? SpringRole::constraint
                       : SpringRole::spring;
        const bool quadratic = !cloth.body && cloth.springs.bend_model == BendModel::quadratic;
        LimitedSprings& springs_of = limits.of_class[k];
        springs_of.exists = quadratic;  // all classes take part in bending
        if (role == SpringRole::off) continue;
        parameters.stiffness[k] = given.stiffness;
        parameters.spring_damping[k] = given.damping;
        springs_of.exists |= role == SpringRole::constraint || given.stiffness > 0 || given.damping > 0;
        if (plan.method == Method::acad) {
            const bool to_rest = plan.acad.target == AcadTarget::rest;
            springs_of.exists = true;
            springs_of.limit = to_rest ? 0 : plan.acad.activate_at;
            springs_of.beyond = 1 / plan.acad.compliance;
            springs_of.compressed = plan.acad.compression || to_rest ? springs_of.beyond : 0;
        } else if (role == SpringRole::constraint) {
            springs_of.limit = given.limit;
            springs_of.below = given.limit > 0 ? given.stiffness : 0;
            springs_of.beyond = 1 / given.compliance;
            springs_of.compressed = plan.newton.resists == Resists::both ? springs_of.beyond : 0;
            // A class without forces has no energy to report.
            if (plan.solver == Solver::newton_multigrid) parameters.stiffness[k] = springs_of.below;
        } else {
            springs_of.below = given.stiffness;
        }
    }
    if (!cloth.body && cloth.springs.bend_model == BendModel::quadratic) {
        const auto bend = static_cast<std::size_t>(SpringClass::bend);
        parameters.stiffness[bend] = 0;
        limits.of_class[bend] = {.exists = true};
    }
}

void SpringLimits::finish(const SteppingPlan& plan, const SpringSet& springs, double mean_mass, Vec3d gravity)
{
    constrain_ = plan.method == Method::constraint;
    remember_ = constrain_ && plan.solver == Solver::newton_multigrid &&
                plan.newton.enforcement == Enforcement::multiplier;
    on_grid_ = plan.on_grid;
    // First-order updates are stable from a quarter of 4.6 on, second-order ones from 6.5 on
    // (docs/physics.md, "Constraints").
    firm_ = plan.meets_colliders ? firm_limit : plan.is_second_order() ? 13 : 4.6;
    mean_mass_ = mean_mass;
    across_ = springs.across;
    length_across_ = springs.length_across;
    gravity_ = std::sqrt(dot(gravity, gravity));
}

bool SpringLimits::remembers(SpringClass spring_class) const
{
    return remember_ && spring_class != SpringClass::bend && of(spring_class).beyond > 0;
}

bool SpringLimits::does_not_stretch(double step_length) const
{
    for (const SpringClass spring_class : {SpringClass::structural, SpringClass::shear}) {
        const bool is_measured = of(spring_class).exists || on_grid_;
        if (is_measured && !(remembers(spring_class) && of(spring_class).beyond > softest(step_length)))
            return false;
    }
    return remembers_any();
}

double SpringLimits::largest() const
{
    double most = 0;
    for (const SpringClass spring_class : {SpringClass::structural, SpringClass::shear})
        if (remembers(spring_class)) most = std::max(most, of(spring_class).limit);
    return most;
}

// A pull passes through n springs in a row at sqrt(k / m) springs per second. With one update per step it
// must pass in about half a step: k = 4.6 m n^2 / dt^2. Below a quarter of that the update itself is unstable
// (docs/physics.md). Cloth held up by colliders is pulled from all sides, and needs four times as much. In
// long steps the limit must bear the cloth's weight at once, m g n over n springs of length L / n, at a
// strain of 0.2 %.
double SpringLimits::softest(double step_length) const
{
    const double line = mean_mass_ * across_ * across_;
    const double weight = gravity_ / length_across_;
    return line * std::max(firm_ / (step_length * step_length), 500 * weight);
}

}  // namespace pliant
