#include "body/cloth_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "body/soft_body.hpp"

namespace pliant {
namespace {

ClothParameters surroundings_of(const Cloth& cloth, const Scene& scene)
{
    ClothParameters parameters;
    parameters.gravity = scene.gravity;
    parameters.wind = scene.air.velocity;
    parameters.air_density = scene.air.density;
    parameters.drag = scene.air.drag;
    parameters.lift = scene.air.lift;
    parameters.damping = cloth.damping;
    parameters.thickness = cloth.thickness;
    return parameters;
}

}  // namespace

ClothModel::ClothModel(const Cloth& cloth, const Scene& scene)
    : plan(cloth, scene),
      shape(cloth),
      masses(cloth, shape),
      attachments(pin_nodes(cloth, shape, masses)),
      parameters(surroundings_of(cloth, scene))
{
    set_springs(cloth, plan, parameters, limits);
    if (cloth.body)
        std::tie(springs, body) = make_soft_body(cloth, plan, shape, masses);
    else
        springs = SpringSet(cloth, plan, shape);
    if (plan.step == SteppingPlan::Step::acad && scene.time.substeps > 0 &&
        1 / (scene.time.frame_rate * scene.time.substeps) > stable_step())
        step_acad_implicitly();
    limits.finish(plan, springs, masses.mean, parameters.gravity);
    if (const auto* mesh = std::get_if<SurfaceMesh>(&cloth.shape); mesh && !plan.keeps_order)
        renumber(node_order(*mesh));
    if (plan.has_solver()) hierarchy = Hierarchy(*this);
}

/// Its steps are longer than explicit springs can stand: they are stepped with their limits.
void ClothModel::step_acad_implicitly()
{
    plan.step = SteppingPlan::Step::newton;
    for (std::size_t k = 0; k < spring_class_count; ++k) {
        limits.of_class[k].below = parameters.stiffness[k];
        // A spring cannot be pulled to its rest length and be a spring, too.
        limits.of_class[k].limit = plan.acad.activate_at;
    }
}

/// order[k] is the vertex that becomes node k.
void ClothModel::renumber(const std::vector<std::uint32_t>& order)
{
    shape.renumber(order);
    masses.renumber(order);
    attachments.renumber(shape.node_of_vertex);
    springs.renumber(order, shape.node_of_vertex);
}

double ClothModel::stable_step() const
{
    // Row sums of norms of M^-1 K and M^-1 C, in 3 x 3 blocks, are at most 2 sum k / m and 2 sum c / m.
    std::vector<double> stiffness(node_count(), 0.0), damping(node_count(), 0.0);
    const auto add = [&](std::uint32_t i, std::uint32_t j, SpringClass spring_class, double scale,
                         double bending) {
        const auto k = static_cast<std::size_t>(spring_class);
        for (const std::uint32_t node : {i, j}) {
            stiffness[node] += scale * parameters.stiffness[k] + bending;
            damping[node] += scale * parameters.spring_damping[k];
        }
    };
    if (plan.on_grid)
        for_each_sheet_spring(*shape.sheet, [&](std::uint32_t i, std::uint32_t j, const SheetNeighbour& n) {
            add(i, j, n.spring_class, 1, 0);
        });
    else
        for (const Spring& spring : springs.list)
            add(spring.i, spring.j, spring.spring_class, spring.scale, std::abs(spring.bending));

    double omega2 = 0, gamma = parameters.damping;
    for (std::size_t i = 0; i < node_count(); ++i) {
        omega2 = std::max(omega2, 2 * stiffness[i] * masses.inverse(i));
        gamma = std::max(gamma, parameters.damping + 2 * damping[i] * masses.inverse(i));
    }
    if (plan.integrator ==
        Integrator::explicit_euler)  // |1 + lambda dt| < 1 while dt < gamma / omega2, gamma >= d
        return omega2 > 0 ? parameters.damping / omega2 : std::numeric_limits<double>::infinity();
    if (plan.integrator == Integrator::runge_kutta_4) {
        // The stability region contains the left half of the disc of this radius; |lambda| <= max(omega,
        // gamma).
        constexpr double radius = 2.6;
        const double fastest = std::max(std::sqrt(omega2), gamma);
        return fastest > 0 ? radius / fastest : std::numeric_limits<double>::infinity();
    }
    // Symplectic Euler on x'' = -gamma x' - omega2 x is stable while 4 - 2 gamma dt - omega2 dt^2 > 0.
    if (omega2 > 0) return (std::sqrt(gamma * gamma + 4 * omega2) - gamma) / omega2;
    return gamma > 0 ? 2 / gamma : std::numeric_limits<double>::infinity();
}

}  // namespace pliant
