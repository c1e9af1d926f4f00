// Integrators: the order of each, and the longest step that each stands.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "physics/measured.hpp"
#include "test_cloths.hpp"
#include "test_differences.hpp"

namespace pliant {
namespace {

/// Whether a sheet is still one after some steps of `step` s. It is held at two corners and drifts a little
/// when these catch it. Without weight it stays flat, where its waves are known.
bool stands(Scene scene, double step, int steps = 500)
{
    scene.gravity = {0, 0, 0};
    scene.time = {.duration = 10, .frame_rate = 1 / step, .substeps = 1};
    scene.cloth_handle(0)->velocity = {0.01, 0, 0.007};
    scene.cloth_handle(0).pin(Corner::top_left).pin(Corner::top_right);
    Simulation simulation(scene, test::on(Backend::cpu));
    const auto x = simulation.positions();
    const std::vector<Vec3> start(x.begin(), x.end());
    for (int n = 0; n < steps && simulation.report().finite; ++n) {
        simulation.advance(step);
        if (n == 10) {
            EXPECT_GT(test::largest_difference(simulation.positions(), start), 1e-6) << "it does not move";
        }
    }
    return simulation.report().finite && simulation.report().measures.max_speed < 1;
}

TEST(Stability, OfAHangingSheetIsAsTheEstimateSays)
{
    Scene scene;
    Cloth cloth = test::flat_sheet(16, 16);
    cloth.damping = 0;
    cloth.springs = {{1000, 0}, {500, 0}, {100, 0}};
    cloth.pin(Corner::top_left).pin(Corner::top_right);
    scene.add(cloth);
    const double stable = Simulation(scene, test::on(Backend::cpu)).stable_step();
    scene.time = {.duration = 1, .frame_rate = 1 / stable, .substeps = 1};
    Simulation simulation(scene, test::on(Backend::cpu));
    EXPECT_TRUE(simulation.stability_warning().empty());
    test::Largest stretch;
    for (int n = 0; n < 8000; ++n) {
        simulation.advance(stable);
        stretch.add(simulation.report().measures.max_stretch);
    }
    EXPECT_TRUE(simulation.report().finite);
    EXPECT_LT(stretch.value(), 0.5);
    EXPECT_GT(stretch.value(), 0.01);  // it carries its weight
    scene.time.frame_rate = 1 / (1.01 * stable);
    EXPECT_FALSE(Simulation(scene, test::on(Backend::cpu)).stability_warning().empty());
}

TEST(Stability, TheEstimateIsShortByWhatIsDerived)
{
    // docs/physics.md#stability: the stiffest wave of a flat sheet with the default springs has omega^2 =
    // 6000 / m, where Gershgorin's theorem has 12080 / m: the step may be sqrt(12080 / 6000) = 1.419 times as
    // long. A wave that ends at the border of 32 nodes has cos(pi / 64) of its frequency, 0.12 % less.
    Scene scene;
    Cloth cloth = Cloth::sheet({.rows = 32, .columns = 32});
    cloth.springs = {{1000, 0}, {500, 0}, {10, 0}};
    cloth.damping = 0;
    scene.add(cloth);
    const double estimate = Simulation(scene, test::on(Backend::cpu)).stable_step();
    EXPECT_TRUE(stands(scene, 1.41 * estimate, 2000));
    EXPECT_FALSE(stands(scene, 1.43 * estimate, 2000));
}

struct Scheme {
    Integrator integrator;
    int order;
    std::uint32_t implicit_order = 1;
};
constexpr Scheme schemes[] = {{Integrator::symplectic_euler, 1},
                              {Integrator::explicit_euler, 1},
                              {Integrator::runge_kutta_4, 4},
                              {Integrator::implicit_euler, 1},
                              {Integrator::implicit_euler, 2, 2}};

/// Where a mass between two springs is after 0.5 s. It starts across them as well as along, so that what they
/// do is not linear; near the origin, a float tells it to 1e-9 m.
Vec3d place_after(const Scheme& scheme, std::uint32_t substeps)
{
    SurfaceMesh mesh{{{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}}, {{0, 1, 2}}};
    Cloth cloth = Cloth::mesh(mesh, {.node_mass = 0.125});
    cloth.springs = {{25, 0.02}, {0, 0}, {0, 0}};
    cloth.damping = 0.1;
    cloth.velocity = {0.5, 3, 0};
    cloth.pin(1u).pin(2u);
    Scene scene;
    scene.integrator = scheme.integrator;
    scene.newton_multigrid.order = scheme.implicit_order;
    scene.time = {.duration = 1, .frame_rate = 20, .substeps = substeps};
    scene.newton_multigrid.newton_iterations = 50;
    scene.newton_multigrid.newton_tolerance = 1e-8;
    scene.newton_multigrid.linear_iterations = 20;
    scene.newton_multigrid.linear_tolerance = 1e-6;
    scene.add(cloth);
    Simulation simulation(scene, test::on(Backend::reference));
    for (int frame = 0; frame < 10; ++frame) simulation.advance(1.0 / 20);
    return to_double(simulation.positions()[0]);
}

TEST(Order, OfPositionsIsThatOfTheIntegrator)
{
    // Row "order": the slope of the position's error over dt, 1 for the Euler family, 2 for BDF2 and 4 for
    // Runge-Kutta,
    // +- 0.1, over four refinements against the limit, which is Runge-Kutta's with a step 18 times finer than
    // its finest here.
    const Vec3d limit = place_after({Integrator::runge_kutta_4, 4}, 256);
    for (const Scheme& scheme : schemes) {
        const bool fourth = scheme.order == 4;
        const bool implicit = scheme.integrator == Integrator::implicit_euler;
        double before = 0, substeps_before = 0;
        for (const std::uint32_t n : {6u, 8u, 12u, 18u, 28u}) {
            const std::uint32_t substeps = fourth ? n / 2 : implicit ? 8 * n : 32 * n;
            const Vec3d d = place_after(scheme, substeps) - limit;
            const double error = std::sqrt(dot(d, d));
            if (substeps_before > 0) {
                const double slope = std::log(before / error) / std::log(substeps / substeps_before);
                const std::string name = std::string(name_of(scheme.integrator)) +
                                         (scheme.implicit_order == 2 ? " of order 2" : "");
                test::measured("order of " + name, slope, scheme.order);
                EXPECT_NEAR(slope, scheme.order, 0.1) << name << ", error " << error;
            }
            before = error;
            substeps_before = substeps;
        }
    }
}

TEST(Order, OfSymplecticEulerWithTheVelocityHalfAStepBehindIsVerlets)
{
    // Row "order": 2, +- 0.1, for Verlet's scheme, x(t + dt) = 2 x(t) - x(t - dt) + dt^2 a(x(t)). Symplectic
    // Euler has these places when its velocity at the start is that of half a step before, v - dt/2 a(x);
    // springs at rest pull nowhere, so that a is gravity.
    const auto place = [](Integrator integrator, std::uint32_t substeps) {
        SurfaceMesh mesh{{{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}}, {{0, 1, 2}}};
        Cloth cloth = Cloth::mesh(mesh, {.node_mass = 0.125});
        cloth.springs = {{25, 0}, {0, 0}, {0, 0}};
        cloth.damping = 0;
        const double dt = 0.05 / substeps;
        cloth.velocity = {0.5, 3, 0};
        if (integrator == Integrator::symplectic_euler) cloth.velocity.y += 9.81 * dt / 2;
        cloth.pin(1u).pin(2u);
        Scene scene;
        scene.integrator = integrator;
        scene.time = {.duration = 1, .frame_rate = 20, .substeps = substeps};
        scene.add(cloth);
        Simulation simulation(scene, test::on(Backend::reference));
        for (int frame = 0; frame < 10; ++frame) simulation.advance(1.0 / 20);
        return to_double(simulation.positions()[0]);
    };
    const Vec3d limit = place(Integrator::runge_kutta_4, 256);
    double before = 0, substeps_before = 0;
    for (const std::uint32_t substeps : {4u, 6u, 9u, 14u, 20u}) {
        const Vec3d d = place(Integrator::symplectic_euler, substeps) - limit;
        const double error = std::sqrt(dot(d, d));
        if (substeps_before > 0) {
            const double slope = std::log(before / error) / std::log(substeps / substeps_before);
            test::measured("order of Verlet's scheme", slope, 2);
            EXPECT_NEAR(slope, 2, 0.1) << "error " << error;
        }
        before = error;
        substeps_before = substeps;
    }
}

TEST(Order, OfASheetIsOneInTheStep)
{
    // The swing of a pinned, sheared sheet after 0.25 s, by the integrator that is the default, against
    // Runge-Kutta's.
    const auto swing = [](Integrator integrator, std::uint32_t substeps) {
        Scene scene;
        scene.integrator = integrator;
        scene.time = {.duration = 1, .frame_rate = 60, .substeps = substeps};
        Cloth cloth = test::flat_sheet(5, 6, 0.5, 0.4);
        cloth.springs = {{30, 0.01}, {15, 0.01}, {1, 0}};
        cloth.pin(Edge::left);
        scene.add(cloth);
        Simulation simulation(scene, test::on(Backend::reference));
        for (int frame = 0; frame < 15; ++frame) simulation.advance(1.0 / 60);
        const auto x = simulation.positions();
        return std::vector<Vec3>(x.begin(), x.end());
    };
    const auto limit = swing(Integrator::runge_kutta_4, 64);
    double before = 0;
    for (const std::uint32_t substeps : {32u, 64u, 128u, 256u, 512u}) {
        const auto x = swing(Integrator::symplectic_euler, substeps);
        double sum = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Vec3d d = to_double(x[i]) - to_double(limit[i]);
            sum += dot(d, d);
        }
        if (substeps > 32) {
            EXPECT_NEAR(std::log2(before / std::sqrt(sum)), 1, 0.1) << substeps;
        }
        before = std::sqrt(sum);
    }
}

/// A sheet as the paper's: figure 10, 32 x 32 nodes, 1000 N/m.
Scene paper_sheet(Integrator integrator, double damping)
{
    Scene scene;
    scene.integrator = integrator;
    Cloth cloth = Cloth::sheet({.rows = 32, .columns = 32, .node_mass = 0.02});
    cloth.springs = {{1000, 0}, {1000, 0}, {1000, 0}};
    cloth.damping = damping;
    scene.add(cloth);
    return scene;
}

TEST(Stability, OfEachIntegratorIsWhereItsTheoryHasIt)
{
    // The stiffest wave of the flat sheet has omega^2 = 8 k / m, all three classes being alike: symplectic
    // Euler stands to omega dt = 2, Runge-Kutta to 2.83, implicit Euler any step, and explicit Euler as far
    // as damping d goes, dt = d / omega^2. Steps are tried a tenth apart.
    const double omega = std::sqrt(8 * 1000 / 0.02);
    const struct {
        Integrator integrator;
        double limit, damping;
    } cases[] = {{Integrator::symplectic_euler, 2 / omega, 0},
                 {Integrator::runge_kutta_4, 2.83 / omega, 0},
                 {Integrator::explicit_euler, 200 / (omega * omega), 200}};
    for (const auto& c : cases) {
        double stable = 0, unstable = 0;
        for (double step = 0.8 * c.limit; step < 3 * c.limit; step *= 1.1) {
            if (!stands(paper_sheet(c.integrator, c.damping), step)) {
                unstable = step;
                break;
            }
            stable = step;
        }
        test::measured(std::string("largest stable step of ") + name_of(c.integrator), stable, c.limit);
        EXPECT_GT(stable, 0.85 * c.limit) << name_of(c.integrator);
        EXPECT_GT(unstable, 0) << name_of(c.integrator);
        EXPECT_LT(unstable, 1.25 * c.limit) << name_of(c.integrator);
    }
    EXPECT_TRUE(stands(paper_sheet(Integrator::implicit_euler, 0), 0.1, 50));
}

}  // namespace
}  // namespace pliant
