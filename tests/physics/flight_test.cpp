// Free flight: what the integrator makes of it, and what must not change; and wind.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "physics/backends.hpp"
#include "solve/frame.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

class Flight : public test::OnEveryBackend {};
INSTANTIATE_TEST_SUITE_P(Physics, Flight, testing::ValuesIn(test::all_backends), test::backend_name);

TEST_P(Flight, AFreeNodeFallsAsTheIntegratorSays)
{
    // v_n = n g dt and x_n = x_0 + g dt^2 n (n + 1) / 2, whatever the springs of a sheet at rest.
    Scene scene;
    scene.time = test::steps(60, 8);
    Cloth cloth = test::flat_sheet(3, 5);
    cloth.damping = 0;
    cloth.position = {0, 4, 0};
    scene.add(cloth);
    Simulation simulation(scene, options());
    for (int frame = 0; frame < 30; ++frame) simulation.advance(1.0 / 60);
    const double n = 240, dt = 1.0 / 480;
    const double height = 4 - 9.81 * dt * dt * n * (n + 1) / 2, speed = -9.81 * n * dt;
    // Each of 240 steps rounds once in float, half an ulp of 4 m or 5 m/s.
    const double tolerance = 240 * 0x1p-24 * 8;
    for (const Vec3& x : simulation.positions()) EXPECT_NEAR(x.y, height, tolerance);
    for (const Vec3& v : simulation.velocities()) EXPECT_NEAR(v.y, speed, tolerance);
}

TEST_P(Flight, AProjectileTakesTheParabolaOfTheIntegrator)
{
    // x_n = x_0 + n dt v and y_n = y_0 + n dt v - g dt^2 n (n + 1) / 2: exact for the scheme, on every
    // backend to rounding.
    Scene scene;
    scene.time = test::steps(60, 8);
    Cloth cloth = test::flat_sheet(4, 4);
    cloth.damping = 0;
    cloth.velocity = {2, 3, -1};
    scene.add(cloth);
    Simulation simulation(scene, options());
    const Vec3 start = simulation.positions()[5];
    for (int frame = 0; frame < 30; ++frame) simulation.advance(1.0 / 60);
    const double n = 240, dt = 1.0 / 480, tolerance = 240 * 0x1p-24 * 8;
    const Vec3 end = simulation.positions()[5];
    EXPECT_NEAR(end.x - start.x, 2 * n * dt, tolerance);
    EXPECT_NEAR(end.y - start.y, 3 * n * dt - 9.81 * dt * dt * n * (n + 1) / 2, tolerance);
    EXPECT_NEAR(end.z - start.z, -n * dt, tolerance);
}

TEST_P(Flight, MomentumIsKeptWithoutGravity)
{
    Scene scene;
    scene.gravity = {0, 0, 0};
    Cloth cloth = Cloth::mesh(test::irregular_mesh(13, 17), {.node_mass = 0.001});
    cloth.damping = 0;
    cloth.springs = {{200, 0.01}, {0, 0}, {5, 0.001}};
    scene.add(cloth);
    ClothModel model(scene.cloth(0), scene);
    std::mt19937 engine(3);
    std::uniform_real_distribution<float> unit(-1, 1);
    Vec3d before;
    for (Vec3& v :
         model.shape.velocities) {  // every node its own way: the springs work hard against each other
        v = {0.3f + unit(engine), -0.2f + unit(engine), 0.1f + unit(engine)};
        before = before + to_double(v);
    }

    constexpr std::uint32_t steps_taken = 3600;
    const auto runner = test::make_runner(GetParam(), model);
    Program program{1, {}, 0};
    program.parity_after = append_frame({&model, 1}, steps_taken, 0, program.calls);
    runner->run(program, {1.0 / 3600, 0, {}, true});
    std::vector<float> v;
    runner->read(0, Resource::velocity, program.parity_after, v);
    Vec3d after;
    for (std::size_t i = 0; i < v.size(); i += 3) after = after + Vec3d{v[i], v[i + 1], v[i + 2]};

    // Forces cancel bit by bit in pairs. What is left is rounding: each step rounds a velocity of about 1
    // m/s, at random, so 3,600 steps of 221 nodes walk sqrt(3,600 * 221) half ulps; on the reference only
    // reading rounds.
    const double nodes = model.node_count(), half_ulp = 0x1p-24;
    const double tolerance = 4 * half_ulp * (exact() ? std::sqrt(nodes) : std::sqrt(steps_taken * nodes));
    EXPECT_NEAR(after.x, before.x, tolerance);
    EXPECT_NEAR(after.y, before.y, tolerance);
    EXPECT_NEAR(after.z, before.z, tolerance);
    EXPECT_GT(runner->measures(0).elastic_energy, 1e-6);  // something happened
}

TEST_P(Flight, WindDrivesASheetToTheSpeedOfTheAir)
{
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.time = test::steps(60, 40);
    scene.air = {.velocity = {0, 2, 0}, .density = 1.2, .drag = 1, .lift = 0};
    Cloth cloth = test::flat_sheet(6, 9, 1, 0.8);
    cloth.damping = 0;
    scene.add(cloth);
    Simulation simulation(scene, options());
    // M v' = rho C_d A (u - v)^2 / 2:  u - v = u / (1 + u t rho C_d A / (2 M)), first order in dt.
    for (int frame = 0; frame < 60; ++frame) simulation.advance(1.0 / 60);
    double mean = 0;
    for (const Vec3& v : simulation.velocities()) mean += v.y / 54;
    const double rate = 1.2 * 0.8 / (2 * 0.3 * 0.8);  // rho C_d A / (2 M), 1/m
    EXPECT_NEAR(mean, 2 - 2 / (1 + 2 * rate),
                0.02);  // edges carry less area than mass, so the sheet bows a little
}

}  // namespace
}  // namespace pliant
