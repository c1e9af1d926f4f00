// How a cloth is stepped: decided once, from the scene, when its model is made.
#pragma once

#include "pliant/scene.hpp"

namespace pliant {

/// Methods that use the constraint solver.
constexpr bool uses_solver(Method method) { return method == Method::constraint || method == Method::acad; }

/// The method whose passes step a scene: implicit Euler uses those of `constraint`, without constraints.
inline Method stepped_method(const Scene& scene)
{
    return scene.integrator == Integrator::implicit_euler ? Method::constraint : scene.method;
}

struct SteppingPlan {
    /// What a step is; src/solve has a sequence of passes for each.
    enum class Step {
        springs,       ///< one explicit step
        stages,        ///< explicit Euler, or the four stages of Runge-Kutta
        body_springs,  ///< a soft body's springs alone, gathered along the ring around each node
        body_list,     ///< the same from the list of springs
        body_volume,   ///< springs and the volume constraint
        newton,        ///< a minimum of the step's energy, by newton_multigrid
        acad,          ///< springs alone, and then a correction of those that are stretched too far
        paper,         ///< the cloth paper's solver
    };

    SteppingPlan() = default;
    /// Throws nothing: `scene` is validated.
    SteppingPlan(const Cloth& cloth, const Scene& scene);

    Step step = Step::springs;
    /// A sheet whose grid says where a node's neighbours and triangles are; otherwise they are listed.
    bool on_grid = false;
    /// Forces of a sheet are gathered node by node along its grid; otherwise by its list of springs.
    bool node_centric = false;
    /// Some springs have a scale, or bending, of their own. A sheet with such springs is stepped as a mesh.
    bool graded = false;
    /// Nodes stay in the order of the mesh, which the paper's solver numbers its rows by.
    bool keeps_order = false;
    bool meets_colliders = false;  ///< the scene has colliders

    Method method = Method::mass_spring;  ///< see stepped_method
    Integrator integrator = Integrator::symplectic_euler;
    Solver solver = Solver::newton_multigrid;
    NewtonMultigridOptions newton;
    PaperOptions paper;
    AcadOptions acad;

    bool has_solver() const { return step == Step::newton || step == Step::acad || step == Step::paper; }
    /// Every step is a step of newton_multigrid. Such steps report their residual and include the hand's
    /// pull.
    bool is_implicit() const { return step == Step::newton; }
    /// ACAD by marks: springs are stepped alone, or by the paper's rows, and those that are stretched too far
    /// are constraints. False where its steps are too long for explicit springs, which are stepped with their
    /// limits.
    bool corrects_steps() const { return method == Method::acad && step != Step::newton; }
    bool is_body() const
    {
        return step == Step::body_springs || step == Step::body_list || step == Step::body_volume;
    }
    /// Whether one pass gathers springs and the ring of neighbours, without a list of forces.
    bool keeps_volume() const { return step == Step::body_volume; }
    bool gathers_rings() const { return step == Step::body_springs || step == Step::body_volume; }
    /// Forces of springs are computed spring by spring, in a pass of their own.
    bool lists_springs() const { return !node_centric && !gathers_rings(); }
    /// Implicit steps use the previous step, too: BDF2 (docs/physics.md, "Constraints").
    bool is_second_order() const { return is_implicit() && newton.order == 2; }
    /// s: with history, an implicit step equals one of implicit Euler of this length.
    double implicit_step(double step_length) const { return (is_second_order() ? 2.0 / 3 : 1) * step_length; }
};

}  // namespace pliant
