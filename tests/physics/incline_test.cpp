// Block on an incline (docs/verification.md): sticks if and only if mu > tan(angle), slides with g (sin - mu
// cos).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "physics/backends.hpp"

namespace pliant {
namespace {

class Incline : public test::OnEveryBackend {};
INSTANTIATE_TEST_SUITE_P(Physics, Incline, testing::ValuesIn(test::all_backends), test::backend_name);

/// Distance in m that a sheet slides down an incline in a second.
double slide(Backend backend, double angle_degrees, double friction)
{
    const double angle = angle_degrees * std::numbers::pi / 180;
    Scene scene;
    scene.time = test::steps(60, 40);
    Cloth cloth = test::flat_sheet(8, 8, 0.4, 0.4);
    cloth.damping = 0;
    cloth.rotation = {0, 0, -angle_degrees};  // down towards positive x
    const Vec3d normal{std::sin(angle), std::cos(angle), 0};
    cloth.position = normal * (cloth.thickness * 0.999);  // in contact from the first step on
    scene.add(cloth);
    scene.add(Plane{.point = {}, .normal = normal, .friction = friction});
    Simulation simulation(scene, test::on(backend));
    const Vec3 start = simulation.positions()[27];
    for (int frame = 0; frame < 60; ++frame) simulation.advance(1.0 / 60);
    const Vec3 end = simulation.positions()[27];
    EXPECT_TRUE(simulation.report().finite);
    return (end.x - start.x) * std::cos(angle) - (end.y - start.y) * std::sin(angle);
}

TEST_P(Incline, AClothOnAnInclineRestsBelowTheFrictionAngleAndSlidesAboveIt)
{
    constexpr double angle = 30;
    const double tangent = std::tan(angle * std::numbers::pi / 180);
    EXPECT_NEAR(slide(GetParam(), angle, 1.01 * tangent), 0, 1e-5);
    // s = g (sin - mu cos) t^2 / 2, first order in dt: (t + dt) / t.
    const double mu = 0.8 * tangent;
    const double expected =
        0.5 * 9.81 *
        (std::sin(angle * std::numbers::pi / 180) - mu * std::cos(angle * std::numbers::pi / 180));
    EXPECT_NEAR(slide(GetParam(), angle, mu), expected, expected * (1.0 / 2400 + 1e-3));
    EXPECT_GT(slide(GetParam(), angle, 0.99 * tangent), 0.01);
}

}  // namespace
}  // namespace pliant
