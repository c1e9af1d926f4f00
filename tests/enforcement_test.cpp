// Limits with memory: a cloth of constraints falls as it does when its steps are solved completely.
#include <gtest/gtest.h>

#include <cmath>

#include "pliant/simulation.hpp"
#include "test_differences.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

struct Fall {
    double lowest_15 = 0, lowest_30 = 0, longest = 0;  // m, m, stretch
};

/// A cloth of 1 m, pinned at two nodes and released from the horizontal.
Fall fall_of(const Cloth& cloth, const NewtonMultigridOptions& options)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.newton_multigrid = options;
    scene.add(cloth);
    Simulation simulation(scene, test::on(Backend::cpu));
    test::Largest longest;
    Fall fall;
    for (int frame = 1; frame <= 30; ++frame) {
        simulation.advance(1.0 / 60);
        longest.add(simulation.report().measures.max_stretch);
        test::Smallest lowest;
        for (const Vec3& x : simulation.positions()) lowest.add(double{x.y});
        if (frame == 15) fall.lowest_15 = lowest.value();
        fall.lowest_30 = lowest.value();
    }
    fall.longest = longest.value();
    return fall;
}

/// The height of its lowest node at frame 30 with completely solved steps, m.
double expect_the_converged_motion(const Cloth& cloth)
{
    NewtonMultigridOptions converged;
    converged.newton_iterations = 60;
    converged.linear_iterations = 40;
    converged.newton_tolerance = 1e-3;
    converged.linear_tolerance = 1e-2;
    const Fall fall = fall_of(cloth, {}), reference = fall_of(cloth, converged);
    EXPECT_LT(reference.lowest_30, -0.5);                     // m: it has fallen
    EXPECT_NEAR(fall.lowest_15, reference.lowest_15, 0.005);  // m
    EXPECT_NEAR(fall.lowest_30, reference.lowest_30, 0.02);   // m
    EXPECT_LE(fall.longest, 0.01);
    return reference.lowest_30;
}

TEST(Enforcement, ASheetFallsAsItDoesWhenSolvedToTheEnd)
{
    Cloth sheet = Cloth::sheet({.rows = 48, .columns = 48, .density = 0.3});
    sheet.damping = 0;
    sheet.pin(Corner::top_left).pin(Corner::top_right);
    expect_the_converged_motion(sheet);
}

TEST(Enforcement, ADiscFallsAsItDoesWhenSolvedToTheEnd)
{
    Cloth disc = Cloth::disc({.radius = 0.5, .rings = 12, .density = 0.3});
    disc.damping = 0;
    disc.pin(std::uint32_t{433}).pin(std::uint32_t{397 + 54});
    const double lowest = expect_the_converged_motion(disc);
    // With a penalty Newton's method must miss these bars; otherwise they would prove nothing.
    NewtonMultigridOptions penalty;
    penalty.enforcement = Enforcement::penalty;
    EXPECT_GT(std::abs(fall_of(disc, penalty).lowest_30 - lowest), 0.02);
}

// A node at the hem of a disc has three or four springs, all in one plane. One damped step of block Jacobi
// may move it out of that plane by 0.7 g dt^2 = 1.9 mm, which stretches springs of 7 mm by 3.5 %.
TEST(Enforcement, NoNodeOfAFineMeshStandsOutOfIt)
{
    constexpr std::uint32_t rings = 73, hem = 1 + 3 * rings * (rings - 1);
    Cloth disc = Cloth::disc({.radius = 0.5, .rings = rings, .density = 0.3});
    disc.pin(hem + 3 * rings / 4).pin(hem + 9 * rings / 4);
    Scene scene;
    scene.method = Method::constraint;
    scene.add(disc);
    Simulation simulation(scene, test::on(Backend::cpu));
    for (int frame = 1; frame <= 40; ++frame) {
        simulation.advance(1.0 / 60);
        ASSERT_LE(simulation.report().measures.max_stretch, 0.01) << "frame " << frame;
    }
}

}  // namespace
}  // namespace pliant
