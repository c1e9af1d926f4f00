// Row "pendulum of one constraint" (docs/verification.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/measured.hpp"
#include "test_cloths.hpp"
#include "test_differences.hpp"

namespace pliant {
namespace {

constexpr double g = 9.81;

/// One link of 1 m, held at one end, with 1 kg at the other; let go at an angle from straight down, in rad.
Scene pendulum(double angle, double dt)
{
    Cloth cloth = Cloth::sheet({.rows = 2, .columns = 2, .width = 0.1, .height = 1, .node_mass = 0.5});
    cloth.rotation = {90 - angle * 180 / std::numbers::pi, 0, 0};
    cloth.springs = {};
    cloth.springs.shear.role = cloth.springs.bend.role = SpringRole::off;
    cloth.damping = 0;
    cloth.pin(Edge::top);
    Scene scene;
    scene.time = {.duration = 1, .frame_rate = 1 / dt, .substeps = 1};
    scene.add(cloth);
    return scene;
}

TEST(PendulumRow, ConvergedStrainIsBelowAMillionth)
{
    // Let go level, the two links carry 3 m g between them at most: 1.5 * 9.81 N * 1e-8 m/N = 1.5e-7 m of 1
    // m.
    Scene scene = pendulum(std::numbers::pi / 2, 1 / 60.0);
    scene.method = Method::constraint;
    scene.cloth_handle(0)->springs.structural = {0, 0, SpringRole::constraint, 0, 1e-8};
    scene.newton_multigrid.enforcement = Enforcement::penalty;  // a force that is remembered is a step behind
    scene.newton_multigrid.newton_iterations = 60;
    scene.newton_multigrid.newton_tolerance = 1e-6;
    scene.newton_multigrid.linear_iterations = 60;
    scene.newton_multigrid.linear_tolerance = 1e-4;
    Simulation simulation(scene, test::on(Backend::reference));
    test::Largest longest;
    for (int step = 0; step < 240; ++step) {
        simulation.advance(1 / 60.0);
        longest.add(simulation.report().measures.max_stretch);
    }
    test::measured("pendulum, converged strain", longest.value());
    EXPECT_LT(longest.value(), 1e-6);

    EXPECT_GT(longest.value(), 1e-8);  // it does carry its weight
}

TEST(PendulumRow, OneLinearisationLeavesHalfTheSquareOfTheTurn)
{
    // The paper's solver linearises a constraint once in a step: a link that turns by omega dt is left longer
    // by (omega dt)^2 / 2. It is largest at the bottom, where omega^2 = 2 g (1 - cos(60 degrees)) / L = g /
    // L.
    for (const double dt : {1 / 60.0, 1 / 120.0, 1 / 240.0, 1 / 480.0}) {
        Scene scene = pendulum(std::numbers::pi / 3, dt);
        scene.method = Method::constraint;
        scene.solver = Solver::paper;
        scene.paper = {.tolerance = 1e-9, .max_iterations = 100, .compliance = 0};
        Simulation simulation(scene, test::on(Backend::reference));
        test::Largest longest;
        for (int step = 0; step < 2 / dt; ++step) {
            simulation.advance(dt);
            longest.add(simulation.report().measures.max_stretch);
        }
        const double expected = g * dt * dt / 2;
        // Of first order itself, since omega is that of a step: 4 % at 1/60 s.
        test::measured("pendulum, one linearisation, dt " + std::to_string(dt), longest.value(), expected);
        EXPECT_NEAR(longest.value() / expected, 1, 4 * dt) << dt;
    }
}

TEST(PendulumRow, EnergyIsOfTheOrderOfTheStepAndHasNoTrend)
{
    // A link of 1e4 N/m by symplectic Euler, let go at 60 degrees: the energy swings with an amplitude
    // proportional to dt and is, over 100 s, where it was: mean of the last 10 s against that of the first,
    // within 0.1 % of m g L.
    double swing_before = 0;
    for (const double dt : {1e-3, 5e-4, 2.5e-4, 1.25e-4}) {
        Scene scene = pendulum(std::numbers::pi / 3, 1.0 / 20);
        scene.time.substeps = static_cast<std::uint32_t>(std::lround(0.05 / dt));
        scene.cloth_handle(0)->springs.structural = {5e3, 0};
        Simulation simulation(scene, test::on(Backend::reference));
        const auto energy = [&] {
            const auto& m = simulation.report().measures;
            return m.kinetic_energy + m.elastic_energy + m.potential_energy;
        };
        const double start = energy(), weight = g * 1.0;  // m g L
        double first = 0, last = 0;
        test::Largest swings;
        for (int frame = 0; frame < 2000; ++frame) {
            simulation.advance(0.05);
            swings.add(std::abs(energy() - start));
            if (frame < 200) first += energy() / 200;
            if (frame >= 1800) last += energy() / 200;
        }
        const double swing = swings.value();
        test::measured("pendulum, energy swing over m g L, dt " + std::to_string(dt), swing / weight);
        test::measured("pendulum, trend of energy over 100 s over m g L", (last - first) / weight);
        EXPECT_NEAR(last, first, 1e-3 * weight) << dt;

        if (dt < 1e-3) {
            EXPECT_NEAR(swing_before / swing, 2, 0.3) << dt;
        }
        swing_before = swing;
    }
}

}  // namespace
}  // namespace pliant
