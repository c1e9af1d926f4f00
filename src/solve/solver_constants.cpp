#include "solve/solver_constants.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/planes.hpp"
#include "solve/frame.hpp"
#include "solve/newton_multigrid.hpp"

namespace pliant {
namespace {

/// ACAD's limits are no stiffer than a step can solve: 1 / (1 / K + a) with the compliance a.
///   Corrected steps: K = 300 m / dt^2. A node that approaches at one spring length per step is stopped
///   within 6 % of it. Implicit, longer steps: K is that of ClothModel::firm_limit. A pull then passes
///   through all springs across the cloth in one step.
/// For soft springs 1e6 N/m would be 10,000 m / dt^2 and more. The error of such a solve gains energy, and
/// the cloth jitters.
template <class T>
void soften_limits_of_acad(SolverConstants<T>& c, const ClothModel& model, double step_length)
{
    const double in_a_row = model.springs.across * model.springs.across;
    const double most =
        (model.plan.corrects_steps() ? 300 : SpringLimits::firm_limit * in_a_row) * model.masses.mean;
    const auto softened = [&](T k) {
        return static_cast<T>(k * most / (most + k * step_length * step_length));
    };
    for (auto& curve : c.curves) {
        curve.beyond = softened(curve.beyond);
        curve.compressed = softened(curve.compressed);
    }
}

/// Constants of ACAD's correction (kernels/acad.kernel.glsl).
template <class T>
void set_acad(SolverConstants<T>& c, const ClothModel& model)
{
    const auto number = [](double a) { return static_cast<T>(a); };
    const AcadOptions& acad = model.plan.acad;
    const bool to_rest = acad.target == AcadTarget::rest;
    const double hold = acad.deactivate_at.value_or(acad.activate_at);
    // A limit may act before the threshold is reached within this step; a constraint to rest length must not.
    // From half of the threshold on, wrinkles would be marked all over the cloth (docs/notes). A large
    // correction marks more springs: those that it may reach.
    constexpr double near_part = 0.8;
    const double near = to_rest ? acad.activate_at : near_part * acad.activate_at;
    const auto above = [&](double stretch) { return number((1 + stretch) * (1 + stretch)); };
    const auto below = [&](double stretch) {
        return number(acad.compression ? (1 - stretch) * (1 - stretch) : 0);
    };
    c.is_acad = true;
    c.acad_has_memory = to_rest && hold < acad.activate_at;
    c.acad_above2 = above(acad.activate_at);
    c.acad_below2 = below(acad.activate_at);
    c.acad_held_above2 = above(hold);
    c.acad_held_below2 = below(hold);
    c.acad_near_above2 = above(near);
    c.acad_near_below2 = below(near);
    c.acad_reach = number(to_rest ? 0 : 1);
    c.has_damping = false;  // springs were damped in their own step
    // The springs' own forces have already acted. Below its limit no force acts on a spring.
    for (auto& curve : c.curves) curve.reach = curve.limit;
}

}  // namespace

template <class T>
SolverConstants<T> make_solver_constants(const ClothModel& model, double step_length, const GrabInput& grab)
{
    const auto number = [](double a) { return static_cast<T>(a); };
    StepConstants<T> step(model, step_length);
    step.set(grab);
    SolverConstants<T> c;
    c.dt = step.dt;
    c.inverse_dt = number(step_length > 0 ? 1 / step_length : 0);
    c.decay = step.decay;
    c.thickness = step.thickness;
    if (model.plan.is_second_order()) {
        const double short_step = model.plan.implicit_step(step_length);
        c.history_plane = model.hierarchy.history_plane;
        c.short_dt = number(short_step);
        c.inverse_short_dt = number(short_step > 0 ? 1 / short_step : 0);
        c.third = number(1.0 / 3);
        c.air = number(model.parameters.damping);
    }
    c.gravity = step.gravity;
    for (std::size_t k = 0; k < spring_class_count; ++k) {
        const LimitedSprings& springs = model.limits.of_class[k];
        const double damping = springs.exists ? model.parameters.spring_damping[k] : 0;
        c.has[k] = springs.exists;
        c.has_damping |= damping > 0;
        c.curves[k] = {springs.curve_kind(),
                       number(springs.below),
                       number(springs.limit),
                       number(springs.beyond),
                       number(springs.compressed),
                       number(step_length > 0 ? damping / model.plan.implicit_step(step_length) : 0),
                       number(springs.below > 0 ? springs.limit : -1),
                       number(1)};
    }
    if (grab.hold > 0 && !model.hierarchy.empty()) {
        const auto columns = static_cast<std::uint32_t>(model.hierarchy.levels.front().columns);
        c.held =
            Hierarchy::offset(model.hierarchy.levels.front(), static_cast<std::int32_t>(grab.node / columns),
                              static_cast<std::int32_t>(grab.node % columns));
        c.hand_target = step.grab_target;
        c.hand_pull = step.grab_pull;
        c.hand_hold = step.grab_hold;
    }
    c.exact_bend = model.limits.bends_by_constraints();
    c.is_graded = model.plan.graded;
    if (model.plan.method == Method::acad) soften_limits_of_acad(c, model, step_length);
    if (model.plan.corrects_steps()) set_acad(c, model);
    std::copy(std::begin(step.rest_lengths), std::end(step.rest_lengths), c.rest_lengths);
    const NewtonMultigridOptions& newton = model.plan.newton;
    // In m / dt^2, the inertia of a node. 100 limits the penetration per step to a hundredth of the
    // displacement. It also keeps a resting node in contact when Newton's method moves it by a hundredth of g
    // dt^2.
    constexpr double by_mass = 100;
    c.contact_is_by_mass = !(newton.contact_stiffness > 0);
    c.contact_stiffness = number(c.contact_is_by_mass ? by_mass : newton.contact_stiffness);
    c.slip = number(newton.friction_speed * step_length);
    // BDF2 does not damp the residual of a step.
    const double part = model.plan.is_second_order() ? 1.0 / 3 : 1;
    c.linear_tolerance = number(newton.linear_tolerance * part);
    c.newton_tolerance = number(newton.newton_tolerance * part);
    c.enough_iterations = number(enough_iterations(model));
    if (step_length > 0 && !model.plan.corrects_steps()) {
        const double softest = model.limits.softest(step_length);
        // A spring at a pinned corner bears the load of about twenty others.
        constexpr double stiffest = 20;
        c.softest_limit = number(softest);
        c.stiffest_limit = number(stiffest * softest);
        for (std::size_t k = 0; k < spring_class_count; ++k) {
            if (!model.limits.remembers(static_cast<SpringClass>(k))) continue;
            c.remembers[k] = true;
            c.curves[k].kept = number(model.limits.kept_when_slack());
            c.compliance[k] = number(1 / model.limits.of_class[k].beyond);
            c.softest[k] = number(model.limits.softest(static_cast<SpringClass>(k), step_length));
        }
        c.polish_reach = number(model.limits.polish_reach());
        c.softest_held_limit = number(SpringLimits::held_limit * softest);
        if (c.remembers[0]) c.softest_held = number(model.limits.softest_held(step_length));
    }
    // Chebyshev's points on the upper part of the spectrum of D^-1 A, which the smoother must damp: a higher
    // degree covers a larger part. Chosen by counting V-cycles (docs/notes).
    const double greatest = model.springs.spectrum_end;
    constexpr std::uint32_t high_degree = 5;
    const double least = greatest / (newton.smoothing < high_degree ? 8 : 32);
    for (std::uint32_t k = 0; k < newton.smoothing; ++k)
        c.relaxations[k] = number(
            1 / (0.5 * (greatest + least) +
                 0.5 * (greatest - least) * std::cos(std::numbers::pi * (k + 0.5) / newton.smoothing)));
    return c;
}

template <class T>
void set_first_numbers(const ClothModel& model, const Hierarchy& hierarchy, T* arena)
{
    if (hierarchy.empty()) return;
    const ConstraintRows& rows = hierarchy.constraints;
    std::transform(rows.numbers.begin(), rows.numbers.end(), arena + rows.first_number,
                   [](double a) { return static_cast<T>(a); });
    if (model.plan.solver == Solver::paper) return;
    const SolverLevel& cloth = hierarchy.levels.front();
    const auto set_edges = [&](const std::vector<double>& values, int plane) {
        std::transform(values.begin(), values.end(), arena + cloth.edge_base + plane * cloth.edge_size,
                       [](double a) { return static_cast<T>(a); });
    };
    set_edges(hierarchy.rest_lengths, edge_rest);
    set_edges(hierarchy.scales, edge_scale);
    set_edges(hierarchy.bending, edge_bending);
    const auto at = [&](int plane, std::int32_t o) -> T& {
        return arena[static_cast<std::size_t>(cloth.base + plane * cloth.size + o)];
    };
    if (model.plan.on_grid)
        for_each_sheet_spring(
            *model.shape.sheet, [&](std::uint32_t i, std::uint32_t, const SheetNeighbour& n) {
                at(plane_scale + n.number,
                   Hierarchy::offset(cloth, static_cast<std::int32_t>(i / model.shape.sheet->columns),
                                     static_cast<std::int32_t>(i % model.shape.sheet->columns))) = T(1);
            });
}

SumParts::SumParts(const ClothModel& model, const Hierarchy& hierarchy)
{
    const SolverLevel& cloth = hierarchy.levels.front();
    const ConstraintRows& rows = hierarchy.constraints;
    const auto parts_of = [&](PassUnit unit) {
        switch (unit) {
            case PassUnit::edge:
            case PassUnit::live_edge: return sum_groups(cloth.edges);
            case PassUnit::spring_row: return sum_groups(static_cast<int>(rows.springs));
            case PassUnit::active_row: return sum_groups(static_cast<int>(rows.constraints));
            default: return cloth.rows * sum_groups(cloth.columns);
        }
    };
    // Passes of a step that share a slot have the same units.
    std::vector<Call> calls;
    append_frame({&model, 1}, 1, 0, calls);
    for (const Call& call : calls) {
        const SumSlots slots = sum_slots_of(call.pass);
        const int parts = parts_of(unit_of(call.pass));
        for (std::uint32_t k = 0; k < slots.count; ++k) {
            counts[slots.first + k] = parts;
            stride = std::max(stride, parts);
        }
    }
}

template void set_first_numbers<double>(const ClothModel&, const Hierarchy&, double*);
template void set_first_numbers<float>(const ClothModel&, const Hierarchy&, float*);
template SolverConstants<double> make_solver_constants<double>(const ClothModel&, double, const GrabInput&);
template SolverConstants<float> make_solver_constants<float>(const ClothModel&, double, const GrabInput&);

}  // namespace pliant
