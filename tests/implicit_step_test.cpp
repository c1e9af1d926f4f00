// The implicit step of the method constraint, in addition to constraint_test.cpp: air, moving surfaces, the
// report of a solve, and the number of V-cycles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pliant/extremes.hpp"
#include "pliant/pliant.hpp"
#include "test_cloths.hpp"
#include "test_cycles.hpp"

namespace pliant {
namespace {

constexpr double frame = 1.0 / 60;  // s

/// A sheet of 6 x 6 nodes that lies in the plane y = 0.
Scene lying_sheet()
{
    Scene scene;
    scene.method = Method::constraint;
    Cloth cloth = test::flat_sheet(6, 6);
    cloth.springs = {{0, 0}, {0, 0}, {1, 0}};
    cloth.damping = 0;
    scene.add(cloth);
    return scene;
}

/// On a plane that does this.
Scene sheet_on(std::vector<Keyframe> keyframes)
{
    Scene scene = lying_sheet();
    scene.cloth_handle(0)->position = {0, scene.cloth(0).thickness, 0};
    scene.add(Plane{.friction = 0.5, .keyframes = std::move(keyframes)});
    return scene;
}

TEST(ImplicitStep, AirTakesAsMuchAsOfAnExplicitStep)
{
    Scene scene = lying_sheet();
    scene.gravity = {};
    scene.cloth_handle(0)->damping = 2;  // 1/s
    scene.cloth_handle(0)->velocity = {1, 0, 0};
    scene.newton_multigrid.newton_tolerance = 1e-6;  // the residual of a step remains in the velocity
    scene.newton_multigrid.linear_tolerance = 1e-4;
    for (const Backend backend : {Backend::reference, Backend::cpu}) {
        Simulation simulation(scene, test::on(backend));
        for (int k = 0; k < 30; ++k) simulation.advance(frame);
        for (const Vec3& v : simulation.velocities()) EXPECT_NEAR(v.x, std::pow(1 - 2 * frame, 30), 1e-5);
    }
}

TEST(ImplicitStep, FrictionTakesAClothAlongWithASurfaceThatMoves)
{
    // 0.2 m/s is reached in 0.04 s at 0.5 g.
    const Scene scene = sheet_on({{0, {0, 0, 0}, {}}, {2, {0.4, 0, 0}, {}}});
    for (const Backend backend : {Backend::reference, Backend::cpu}) {
        Simulation simulation(scene, test::on(backend));
        for (int k = 0; k < 30; ++k) simulation.advance(frame);
        for (const Vec3& v : simulation.velocities())
            EXPECT_NEAR(v.x, 0.2, 1.05 * scene.newton_multigrid.friction_speed) << name_of(backend);
    }
}

TEST(ImplicitStep, APlateThatRisesIsWhereItIsAtTheEndOfEachStep)
{
    // By 1 mm per step: the previous position would be off by 1 mm. A node penetrates by m g / k = 0.8 um,
    // and the first step is not solved completely.
    const Scene scene = sheet_on({{0, {0, 0, 0}, {}}, {2, {0, 0.12, 0}, {}}});
    for (const Backend backend : {Backend::reference, Backend::cpu}) {
        Simulation simulation(scene, test::on(backend));
        for (int k = 1; k <= 30; ++k) {
            simulation.advance(frame);
            for (const Vec3& x : simulation.positions())
                ASSERT_NEAR(x.y, 0.06 * k * frame + scene.cloth(0).thickness, 1e-5)
                    << name_of(backend) << ", " << k;
        }
    }
}

TEST(ImplicitStep, WhatFliesWithoutForcesIsSolvedAtOnce)
{
    // Straight on, and turning once in 6 s: springs have to bend its way by (w h)^2 / 2 of 0.7 m, a hundredth
    // of it.
    for (const std::uint32_t order : {1u, 2u})
        for (const float turn : {0.0f, 1.0f}) {
            Scene scene = lying_sheet();
            scene.gravity = {};
            scene.newton_multigrid.order = order;
            Simulation simulation(scene, test::on(Backend::cpu));
            State state = simulation.state();
            for (std::size_t i = 0; i < state.cloths[0].positions.size(); ++i) {
                const Vec3 x = state.cloths[0].positions[i];
                state.cloths[0].velocities[i] = {0.5f - turn * x.z, 0.2f, turn * x.x};
            }
            simulation.set_state(state);
            for (int k = 0; k < 60; ++k) simulation.advance(frame);
            const SolverReport& solver = simulation.report().solver;
            EXPECT_TRUE(solver.is_solved()) << solver.residual_max;
            EXPECT_EQ(solver.frames_cut, 0u);
            EXPECT_LE(solver.newton_max, 8u) << "order " << order << ", turn " << turn;
        }
}

TEST(ImplicitStep, WhatRestsWithoutForcesIsSolvedAtOnce)
{
    // Rounding alone moves it, the more the farther away it is.
    for (const bool mesh : {false, true})
        for (const double away : {0.0, 3.0, 100.0})
            for (const bool rods : {false, true}) {
                Scene scene;
                scene.method = Method::constraint;
                scene.gravity = {};
                if (rods) scene.newton_multigrid.resists = Resists::both;
                Cloth cloth = mesh ? Cloth::mesh(test::irregular_mesh(13, 9), {.density = 0.3})
                                   : test::flat_sheet(9, 13, 1.2, 0.8);
                cloth.position = {away, 0.2, 0};
                cloth.rotation = {20, 30, 40};
                scene.add(cloth);
                Simulation simulation(scene, test::on(Backend::cpu));
                for (int k = 0; k < 60; ++k) simulation.advance(frame);
                const SolverReport& solver = simulation.report().solver;
                EXPECT_TRUE(solver.is_solved())
                    << solver.residual_max << " mesh " << mesh << ", away " << away;
                EXPECT_EQ(solver.frames_cut, 0u) << "mesh " << mesh << ", away " << away << ", rods " << rods;
                EXPECT_LE(solver.newton_max, 8u);
            }
}

Scene hanging_sheet(std::uint32_t n, double compliance = 1e-6)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.time.substeps = 1;
    Cloth cloth = test::flat_sheet(n, n);
    cloth.springs = {{0, 0}, {0, 0}, {1, 0}};
    cloth.springs.structural.compliance = cloth.springs.shear.compliance = compliance;
    cloth.pin(Corner::top_left).pin(Corner::top_right);
    scene.add(cloth);
    return scene;
}

TEST(ImplicitStep, TheLargestResidualIsThatOfAllSteps)
{
    // The same steps, one or four in a frame.
    Scene one = hanging_sheet(8), four = one;
    one.time.frame_rate = 240;
    four.time.substeps = 4;
    for (const Backend backend : {Backend::reference, Backend::cpu}) {
        Simulation by_step(one, test::on(backend)), by_frame(four, test::on(backend));
        double largest = 0;
        for (int k = 0; k < 20; ++k) {
            by_frame.advance(frame);
            for (int step = 0; step < 4; ++step) {
                by_step.advance(frame / 4);
                largest = larger(largest, by_step.report().solver.residual_last);
                ASSERT_EQ(by_step.report().solver.residual_max, largest)
                    << name_of(backend) << ", frame " << k;
            }
            ASSERT_EQ(by_frame.report().solver.residual_max, largest) << name_of(backend) << ", frame " << k;
        }
        ASSERT_EQ(by_step.state_hash(), by_frame.state_hash());
        EXPECT_NE(by_step.report().solver.residual_last, largest);  // otherwise the test above would prove
                                                                    // nothing
    }
}

/// The loss of a sheet that is released 10 % too long, over 1/60 s in `steps` steps, relative to the kinetic
/// energy gained from its springs by then.
double lost_share(std::uint32_t steps)
{
    Scene scene = hanging_sheet(6, 1e-2);
    scene.gravity = {};
    scene.time.frame_rate = 60.0 * steps;
    scene.cloth_handle(0)->damping = 0;
    scene.newton_multigrid.resists = Resists::both;
    scene.newton_multigrid.newton_iterations = 60;
    scene.newton_multigrid.newton_tolerance = 1e-6;
    scene.newton_multigrid.linear_iterations = 60;
    scene.newton_multigrid.linear_tolerance = 1e-4;
    Simulation simulation(scene, test::on(Backend::reference));
    State stretched = simulation.state();
    const Vec3 corner = stretched.cloths[0].positions[0];
    for (Vec3& x : stretched.cloths[0].positions)
        for (float Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z})
            x.*axis = corner.*axis + 1.1f * (x.*axis - corner.*axis);
    simulation.set_state(stretched);
    for (std::uint32_t step = 0; step < steps; ++step) simulation.advance(1 / scene.time.frame_rate);
    EXPECT_LE(simulation.report().solver.residual_max, 1e-6);
    return simulation.report().solver.energy_lost / simulation.report().measures.kinetic_energy;
}

TEST(ImplicitStep, LosesNoEnergyByNotConvergingWhereItConverges)
{
    // A converged step loses what implicit Euler loses, first order in its length: half the step, half the
    // loss, up to second order.
    const double coarse = lost_share(32), fine = lost_share(64);
    EXPECT_GT(fine, 0);
    EXPECT_LT(fine, 0.1);
    EXPECT_NEAR(coarse / fine, 2, 0.2);
}

TEST(SheetHierarchy, CyclesDoNotGrowWithTheSheet)
{
    for (const std::uint32_t n : {16u, 33u, 64u})
        for (const double compliance : {1e-6, 1e-4}) {
            Scene scene = hanging_sheet(n, compliance);
            test::expect_few_cycles(
                scene, {25, 25, 25},
                (testing::Message() << n << " x " << n << " nodes, compliance " << compliance).GetString());
        }
}

}  // namespace
}  // namespace pliant
