#include "body/stepping_plan.hpp"

namespace pliant {

SteppingPlan::SteppingPlan(const Cloth& cloth, const Scene& scene)
    : meets_colliders(!scene.colliders.empty()),
      method(stepped_method(scene)),
      integrator(scene.integrator),
      solver(integrator == Integrator::implicit_euler ? Solver::newton_multigrid : scene.solver),
      newton(scene.newton_multigrid),
      paper(scene.paper),
      acad(scene.acad)
{
    const bool stages = integrator == Integrator::explicit_euler || integrator == Integrator::runge_kutta_4;
    const bool lists_springs = cloth.formulation == Formulation::spring_list;
    if (cloth.body && scene.method == Method::volume && cloth.body->volume.constraint)
        step = Step::body_volume;
    else if (cloth.body)
        step = scene.method == Method::mass_spring && lists_springs ? Step::body_list : Step::body_springs;
    else if (!uses_solver(method))
        step = stages ? Step::stages : Step::springs;
    else if (solver == Solver::paper)
        step = Step::paper;
    else
        step = method == Method::acad ? Step::acad : Step::newton;

    const auto* sheet = std::get_if<SheetOptions>(&cloth.shape);
    graded = !cloth.body && (cloth.springs.bend_model == BendModel::quadratic ||
                             (sheet && sheet->border == SheetBorder::half));
    on_grid = sheet && !graded;
    // Stages and the paper's rows go by springs.
    node_centric = on_grid && !lists_springs && step != Step::paper && !stages;
    keeps_order = cloth.body || step == Step::paper;
}

}  // namespace pliant
