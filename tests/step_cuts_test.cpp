// Steps that were not solved are taken anew in shorter ones, and what limits remember fits steps of any
// length.
#include <gtest/gtest.h>

#include <cmath>

#include "pliant/simulation.hpp"
#include "test_differences.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

constexpr double frame = 1.0 / 60;

class StepCuts : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Backends, StepCuts,
                         testing::Values(Backend::reference, Backend::cpu, Backend::vulkan),
                         [](const auto& backend) { return std::string(name_of(backend.param)); });

/// A sheet that swings, and a disc that falls on a ball, by a solver that hardly works.
Scene hardly_solved(std::uint32_t substeps, std::uint32_t cuts)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.time.substeps = substeps;
    scene.newton_multigrid.newton_iterations = 1;
    scene.newton_multigrid.linear_iterations = 1;
    scene.newton_multigrid.step_cuts = cuts;
    scene.add(Cloth::sheet({.rows = 9, .columns = 7, .density = 0.3}));
    scene.cloth_handle(0)->position = {2, 0, 0};
    scene.cloth_handle(0)->pin(Corner::top_left).pin(Corner::top_right);
    scene.add(Cloth::disc({.radius = 0.3, .rings = 4, .density = 0.3}));
    scene.cloth_handle(1)->position = {0, 0.36, 0};
    scene.add(Sphere{.centre = {0, 0, 0}, .radius = 0.3, .friction = 0.5});
    return scene;
}

/// The first frame that is cut when it is stepped so.
std::uint64_t first_cut_frame(Backend backend)
{
    Simulation simulation(hardly_solved(1, 1), test::on(backend));
    while (simulation.report().solver.frames_cut == 0 && simulation.report().frames < 60)
        simulation.advance(frame);
    return simulation.report().frames;
}

/// In positions, m, and velocities, tenths of a m/s.
bool are_equal(const State& a, const State& b, std::size_t cloth, double tolerance)
{
    test::Largest off;
    for (std::size_t i = 0; i < a.cloths[cloth].positions.size(); ++i) {
        const Vec3d x = to_double(a.cloths[cloth].positions[i]) - to_double(b.cloths[cloth].positions[i]);
        const Vec3d v = to_double(a.cloths[cloth].velocities[i]) - to_double(b.cloths[cloth].velocities[i]);
        off.add(std::sqrt(dot(x, x)));
        off.add(0.1 * std::sqrt(dot(v, v)));
    }
    return off.value() <= tolerance;
}

TEST_P(StepCuts, AreTheShorterStepsThatOneCouldHaveAskedFor)
{
    const std::uint64_t cut_frame = first_cut_frame(GetParam());
    ASSERT_GT(cut_frame, 1u);  // there is something to remember
    ASSERT_LT(cut_frame, 60u);
    // A state is in float, and the reference steps in double; a step that is hardly solved shows which
    // springs of the disc rounding takes for slack. Steps of another length are 6 mm off and more.
    const double tolerance = GetParam() == Backend::reference ? 3e-4 : 0;
    for (const std::uint32_t substeps : {1u, 2u}) {
        Simulation cut(hardly_solved(substeps, 1), test::on(GetParam()));
        State before = cut.state();
        while (cut.report().solver.frames_cut == 0) {
            before = cut.state();
            cut.advance(frame);
        }
        const SolverReport& solver = cut.report().solver;
        const std::uint64_t cut_cloths = solver.frames_cut;
        EXPECT_EQ(solver.steps_added, 2 * substeps * cut_cloths);

        Simulation shorter(hardly_solved(3 * substeps, 0), test::on(GetParam()));
        Simulation whole(hardly_solved(substeps, 0), test::on(GetParam()));
        for (Simulation* other : {&shorter, &whole}) {
            other->set_state(before);
            other->advance(frame);
        }
        EXPECT_EQ(shorter.report().solver.frames_cut, 0u);
        EXPECT_GT(whole.report().solver.residual_max, 1);
        std::size_t like_shorter = 0;
        for (std::size_t c = 0; c < 2; ++c) {
            const State a = cut.state(), b = shorter.state(), w = whole.state();
            const bool is_cut = are_equal(a, b, c, tolerance);
            like_shorter += is_cut ? 1 : 0;
            // The other cloth is left as its own steps, which were solved, have brought it.
            EXPECT_NE(is_cut, are_equal(a, w, c, tolerance)) << "cloth " << c;
        }
        EXPECT_EQ(like_shorter, cut_cloths);
        EXPECT_EQ(cut.time(), shorter.time());
    }
}

// The parts of a first cut overwrite the state that a frame of one step begins with.
TEST_P(StepCuts, TwiceBeginWhereTheFrameBegan)
{
    if (GetParam() == Backend::reference) GTEST_SKIP() << "states are in float, and it steps in double";
    const auto scene_of = [](std::uint32_t substeps, std::uint32_t cuts) {
        Scene scene = hardly_solved(substeps, cuts);
        scene.cloth_handle(1)->position = {0, 0.8, 0};  // so that it is fast when it meets the ball
        return scene;
    };
    Simulation cut(scene_of(1, 2), test::on(GetParam()));
    State before;
    std::uint64_t added = 0;
    while (added != 8 && cut.report().frames < 120) {
        before = cut.state();
        const std::uint64_t so_far = cut.report().solver.steps_added;
        cut.advance(frame);
        added = cut.report().solver.steps_added - so_far;
    }
    ASSERT_EQ(added, 8u) << "no frame in which one cloth was cut in nine";
    Simulation shorter(scene_of(9, 0), test::on(GetParam()));
    shorter.set_state(before);
    shorter.advance(frame);
    const State a = cut.state(), b = shorter.state();
    EXPECT_EQ(are_equal(a, b, 0, 0) + are_equal(a, b, 1, 0), 1);
}

TEST_P(StepCuts, AreNotTakenWhereStepsAreSolved)
{
    Scene scene = hardly_solved(1, 2);
    scene.newton_multigrid.newton_iterations = 8;
    scene.newton_multigrid.linear_iterations = 8;
    Simulation simulation(scene, test::on(GetParam()));
    for (int k = 0; k < 20; ++k) simulation.advance(frame);
    EXPECT_EQ(simulation.report().solver.frames_cut, 0u);
    EXPECT_EQ(simulation.report().solver.steps_added, 0u);
    EXPECT_LE(simulation.report().solver.residual_max, 1);
}

// A sheet that hangs still carries the same forces in whatever steps it is taken on. Without
// fit_solver_memory a step of a third begins with nine times the tension.
TEST_P(StepCuts, AndOtherStepsOfAnotherLengthLeaveAHangingSheetAtRest)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.newton_multigrid.newton_tolerance = 1e-3;
    scene.newton_multigrid.linear_tolerance = 1e-2;
    Cloth sheet = Cloth::sheet({.rows = 6, .columns = 6, .density = 0.3});
    sheet.rotation = {90, 0, 0};  // degrees: hanging from its top
    sheet.damping = 5;
    sheet.pin(Edge::top);
    scene.add(sheet);
    scene.time.frame_rate = 60;
    Simulation simulation(scene, test::on(GetParam()));
    for (int k = 0; k < 120; ++k) simulation.advance(frame);
    ASSERT_LT(simulation.report().measures.max_speed, 1e-3);
    State hanging = simulation.state();
    EXPECT_EQ(hanging.step, simulation.step_length());
    for (const double rate : {180.0, 30.0}) {
        scene.time.frame_rate = rate;
        Simulation other(scene, test::on(GetParam()));
        other.set_state(hanging);
        other.advance(1 / rate);
        EXPECT_LT(other.report().measures.max_speed, 2e-3) << rate;
        hanging.step = 0;  // and without knowing of what steps the memory is, it jerks
        if (rate < 60) continue;
        other.set_state(hanging);
        other.advance(1 / rate);
        EXPECT_GT(other.report().measures.max_speed, 0.02);
    }
}

TEST_P(StepCuts, AreNotNeededForASecondASecondInOneStep)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.time.frame_rate = 1;
    scene.time.substeps = 1;
    scene.add(Cloth::sheet({.rows = 5, .columns = 5, .density = 1}));
    scene.cloth_handle(0)->damping = 0;
    Simulation simulation(scene, test::on(GetParam()));
    simulation.advance(1);
    EXPECT_EQ(simulation.steps_per_frame(), 20u);
    EXPECT_EQ(simulation.report().steps, 20u);
    // Implicit Euler falls g t (t + dt) / 2.
    test::Largest off;
    for (const Vec3& x : simulation.positions()) off.add(std::abs(double{x.y} + 9.81 * (1 + 0.05) / 2));
    EXPECT_LE(off.value(), 1e-4);
}

}  // namespace
}  // namespace pliant
