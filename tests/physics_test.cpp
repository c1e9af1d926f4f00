// Physics against analytic references; every tolerance comes from the order of the method or from rounding.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "solve/frame.hpp"
#include "solve/mass_spring.hpp"
#include "test_cloths.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

const Backend all_backends[] = {Backend::reference, Backend::cpu, Backend::vulkan};

class OnEveryBackend : public testing::TestWithParam<Backend> {
protected:
    SimulationOptions options() const { return test::on(GetParam()); }
    bool exact() const { return GetParam() == Backend::reference; }
};
INSTANTIATE_TEST_SUITE_P(Physics, OnEveryBackend, testing::ValuesIn(all_backends),
                         [](const auto& backend) { return std::string(name_of(backend.param)); });

TimeOptions steps(double frame_rate, std::uint32_t substeps)
{
    return {.duration = 1, .frame_rate = frame_rate, .substeps = substeps};
}

TEST_P(OnEveryBackend, AFreeNodeFallsAsTheIntegratorSays)
{
    // v_n = n g dt and x_n = x_0 + g dt^2 n (n + 1) / 2, whatever the springs of a sheet at rest.
    Scene scene;
    scene.time = steps(60, 8);
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

/// Period of a mass on a spring from the times at which it passes its rest length upwards, by linear
/// interpolation.
double measured_period(double dt, int periods)
{
    // A triangle flat to a line: node 0 is free between nodes 1 and 2, which are pinned at both sides of it.
    constexpr double k = 50, m = 0.125;
    SurfaceMesh mesh{{{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}}, {{0, 1, 2}}};
    Cloth cloth = Cloth::mesh(mesh, {.node_mass = m});
    cloth.springs = {{k / 2, 0}, {0, 0}, {0, 0}};  // two springs on one line pull together with k
    cloth.damping = 0;
    cloth.pin(1u).pin(2u);
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.time = {.duration = 1, .frame_rate = 1 / dt, .substeps = 1};
    auto handle = scene.add(cloth);
    handle->velocity = {0.5, 0, 0};
    SimulationOptions options;
    options.backend = Backend::reference;
    Simulation simulation(scene, options);

    double before = 0, first = -1, last = -1;
    int crossings = 0;
    for (int n = 1; crossings <= periods; ++n) {
        simulation.advance(dt);
        const double x = simulation.positions()[0].x;
        if (before < 0 && x >= 0) {
            const double t = (n - 1 + before / (before - x)) * dt;
            if (crossings++ == 0) first = t;
            last = t;
        }
        before = x;
    }
    return (last - first) / periods;
}

TEST(Oscillator, PeriodHasTheErrorOfSymplecticEuler)
{
    // omega_num = (2 / dt) asin(omega dt / 2): the period is short by (omega dt)^2 / 24, second order.
    const double omega = std::sqrt(50 / 0.125);
    double error_before = 0;
    for (const double dt : {0.008, 0.004, 0.002}) {
        const double numerical = std::numbers::pi * dt / std::asin(omega * dt / 2);
        const double period = measured_period(dt, 200);
        // Positions are reported as float; 200 periods average the crossing times to 1e-6 of a period.
        EXPECT_NEAR(period / numerical, 1, 1e-5) << dt;
        const double error = 1 - period / (2 * std::numbers::pi / omega);
        EXPECT_NEAR(error, omega * omega * dt * dt / 24, 0.05 * omega * omega * dt * dt / 24) << dt;
        if (error_before > 0) {
            EXPECT_NEAR(error_before / error, 4, 0.2);
        }
        error_before = error;
    }
}

TEST_P(OnEveryBackend, MomentumIsKeptWithoutGravity)
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
    for (Vec3& v : model.velocities) {  // every node its own way: the springs work hard against each other
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

TEST_P(OnEveryBackend, AHangingChainStretchesByTheWeightBelow)
{
    // A ladder of two columns pinned at the top: each rung's two vertical springs carry the weight of the
    // nodes below, l_r = l_0 (1 + ...), elongation of rung r: (R - r) m g / k per column. Shear and bend are
    // off.
    constexpr std::uint32_t rows = 9;
    constexpr double k = 40, m = 0.002, g = 9.81;
    Scene scene;
    scene.time = steps(60, 40);
    Cloth cloth = Cloth::sheet({.rows = rows, .columns = 2, .width = 0.1, .height = 0.8, .node_mass = m});
    cloth.rotation = {90, 0, 0};
    cloth.position = {0, 1, 0};
    cloth.springs = {{k, 0.05}, {0, 0}, {0, 0}};
    cloth.damping = 3;  // comes to rest
    cloth.pin(Edge::top);
    scene.add(cloth);
    Simulation simulation(scene, options());
    for (int frame = 0; frame < 600; ++frame) simulation.advance(1.0 / 60);
    double elongation = 0, expected = 0;
    const auto x = simulation.positions();
    for (std::uint32_t r = 1; r < rows; ++r) {
        expected += (rows - r) * m * g / k;
        elongation = x[0].y - x[2 * r].y - 0.1 * r;
        // At rest the sum is exact. In float a node stops where a step moves it by less than half an ulp of
        // 1 m, that is at a = 3e-8 m / dt^2 = 0.17 m/s2; nodes of 2 g on 40 N/m may keep (R - r) m a / k of
        // that per rung, 3e-4 m in all. Swinging carries them nearer: 2e-5 holds.
        EXPECT_NEAR(elongation, expected, exact() ? 1e-6 : 2e-5) << r;
    }
    EXPECT_LT(simulation.report().measures.max_speed, 1e-3);
}

/// Distance in m that a sheet slides down an incline in a second.
double slide(Backend backend, double angle_degrees, double friction)
{
    const double angle = angle_degrees * std::numbers::pi / 180;
    Scene scene;
    scene.time = steps(60, 40);
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

TEST_P(OnEveryBackend, AClothOnAnInclineRestsBelowTheFrictionAngleAndSlidesAboveIt)
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

TEST(Energy, OfAnUndampedSheetHasNoTrend)
{
    // A symplectic method keeps a modified energy: the error oscillates with O(dt) and does not drift.
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.time = steps(60, 80);
    Cloth cloth = Cloth::sheet({.rows = 6, .columns = 7, .node_mass = 0.01});
    cloth.springs = {{50, 0}, {25, 0}, {1, 0}};
    cloth.damping = 0;
    cloth.pin(Corner::top_left).pin(Corner::bottom_right);
    auto handle = scene.add(cloth);
    handle->velocity = {0.2, 0.1, -0.1};
    SimulationOptions options;
    options.backend = Backend::reference;
    Simulation simulation(scene, options);
    const auto energy = [&] {
        return simulation.report().measures.kinetic_energy + simulation.report().measures.elastic_energy;
    };
    const double start = energy();
    double first_half = 0, second_half = 0;
    for (int frame = 0; frame < 1200; ++frame) {
        simulation.advance(1.0 / 60);
        EXPECT_NEAR(energy() / start, 1, 0.02);
        (frame < 600 ? first_half : second_half) += energy() / 600;
    }
    EXPECT_NEAR(second_half / first_half, 1, 0.002);
}

TEST(Order, OfPositionsIsOneInTheStep)
{
    // The swing of a pinned, sheared sheet after 0.25 s against a run with a step 16 times finer.
    const auto run = [](std::uint32_t substeps) {
        Scene scene;
        scene.time = steps(60, substeps);
        Cloth cloth = test::flat_sheet(5, 6, 0.5, 0.4);
        cloth.springs = {{30, 0.01}, {15, 0.01}, {1, 0}};
        cloth.pin(Edge::left);
        scene.add(cloth);
        SimulationOptions options;
        options.backend = Backend::reference;
        Simulation simulation(scene, options);
        for (int frame = 0; frame < 15; ++frame) simulation.advance(1.0 / 60);
        const auto x = simulation.positions();
        return std::vector<Vec3>(x.begin(), x.end());
    };
    const auto exact = run(1024), coarse = run(32), fine = run(64);
    double coarse_error = 0, fine_error = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const Vec3d a = to_double(coarse[i]) - to_double(exact[i]),
                    b = to_double(fine[i]) - to_double(exact[i]);
        coarse_error += dot(a, a);
        fine_error += dot(b, b);
    }
    // Against the finest run rather than the limit: (1/32 - 1/1024) / (1/64 - 1/1024) = 2.07.
    EXPECT_NEAR(std::log2(std::sqrt(coarse_error / fine_error)), std::log2(2.067), 0.1);
}

TEST(Stability, TheEstimateIsSafeAndNotFarFromTheTruth)
{
    const auto finite_with = [](double fraction) {
        Scene scene;
        Cloth cloth = test::flat_sheet(16, 16);
        cloth.damping = 0;
        cloth.springs = {{1000, 0}, {500, 0}, {100, 0}};
        cloth.pin(Corner::top_left).pin(Corner::top_right);
        scene.add(cloth);
        SimulationOptions options;
        options.backend = Backend::cpu;
        const double stable = Simulation(scene, options).stable_step();
        scene.time = {.duration = 1, .frame_rate = 1 / (fraction * stable), .substeps = 1};
        Simulation simulation(scene, options);
        EXPECT_EQ(simulation.stability_warning().empty(), fraction <= 1) << fraction;
        for (int n = 0; n < 8000 && simulation.report().finite; ++n) simulation.advance(fraction * stable);
        return simulation.report().finite && simulation.report().measures.max_stretch < 0.5;
    };
    EXPECT_TRUE(finite_with(1.0));
    EXPECT_FALSE(finite_with(2.0));
}

TEST_P(OnEveryBackend, WindDrivesASheetToTheSpeedOfTheAir)
{
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.time = steps(60, 40);
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
