// Implicit steps of second order (BDF2): what a swing keeps, how fast errors fall, and when a step is of
// first order after all.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pliant/pliant.hpp"
#include "test_cloths.hpp"
#include "test_differences.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

constexpr double g = 9.81, frame = 1.0 / 60;  // m/s2, s

/// Two columns of nodes, 1 m long and held at the top, at an angle from straight down; rad. Its structural
/// springs are constraints, and there are no others.
Scene strip(std::uint32_t rows, double angle, std::uint32_t order)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.newton_multigrid.order = order;
    Cloth cloth =
        Cloth::sheet({.rows = rows, .columns = 2, .width = 0.1, .height = 1, .node_mass = 0.5 / rows});
    cloth.rotation = {90 - angle * 180 / std::numbers::pi, 0, 0};
    cloth.damping = 0;
    cloth.springs = {};
    cloth.springs.structural = {0, 0};
    cloth.springs.shear.role = cloth.springs.bend.role = SpringRole::off;
    cloth.pin(Edge::top);
    scene.add(cloth);
    return scene;
}

/// What a strip without shear springs asks for: nothing else takes what a step leaves.
void tighten(Scene& scene)
{
    scene.newton_multigrid.newton_tolerance = 0.01;
    scene.newton_multigrid.linear_tolerance = 0.05;
}

/// A swinging sheet of 1 m that is held by an edge.
Scene sheet(std::uint32_t n, std::uint32_t order)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.newton_multigrid.order = order;
    Cloth cloth = Cloth::sheet({.rows = n, .columns = n, .density = 0.3});
    cloth.rotation = {60, 0, 0};
    cloth.damping = 0;
    cloth.springs = {};
    cloth.springs.structural = cloth.springs.shear = {0, 0};
    cloth.springs.bend = {1, 0};
    cloth.pin(Edge::top);
    scene.add(cloth);
    return scene;
}

double energy_of(const Simulation& simulation)
{
    const FrameMeasures& m = simulation.report().measures;
    return m.kinetic_energy + m.potential_energy + m.elastic_energy;
}

/// J, in some seconds. In every second its peak must be lower than in the one before.
double loss_of(const Scene& scene, int seconds)
{
    Simulation simulation(scene, test::on(Backend::cpu));
    const double start = energy_of(simulation);
    double before = start;
    for (int second = 0; second < seconds; ++second) {
        test::Largest peak;
        for (int k = 0; k < 60; ++k) {
            simulation.advance(frame);
            peak.add(energy_of(simulation));
        }
        EXPECT_LE(peak.value(), before) << "energy rises in second " << second;
        before = peak.value();
    }
    EXPECT_LT(simulation.report().measures.max_stretch, 0.01);
    return start - energy_of(simulation);
}

TEST(SecondOrder, SwingsLoseAFifthOfWhatEulerTakes)
{
    for (const std::uint32_t rows : {2u, 8u}) {
        Scene first = strip(rows, std::numbers::pi / 6, 1), second = strip(rows, std::numbers::pi / 6, 2);
        tighten(first);
        tighten(second);
        const double euler = loss_of(first, 10), bdf2 = loss_of(second, 10);
        EXPECT_GT(euler, 0.01) << rows << " rows: it does not swing";
        EXPECT_LT(bdf2, euler / 5) << rows << " rows";
    }
    // By the tolerances of order 1 a sheet of 48 x 48 keeps the bar, and one of 64 x 64 does not.
    const double euler = loss_of(sheet(64, 1), 10), bdf2 = loss_of(sheet(64, 2), 10);
    EXPECT_GT(euler, 0.1) << "it does not swing";
    EXPECT_LT(bdf2, euler / 5);
}

TEST(SecondOrder, ASwingIsDampedAsItsTheorySays)
{
    // Of BDF2 a swing of angular frequency w loses its amplitude at the rate w^4 dt^3 / 4, up to (w dt)^2 of
    // itself: at 20 steps a second 3.0e-3 1/s, up to 3 %. Implicit Euler: 0.25.
    Scene scene = strip(2, 0.1, 2);
    test::converge(scene);
    scene.time.frame_rate = 20;
    Simulation simulation(scene, test::on(Backend::reference));
    const double x0 = simulation.positions()[0].z;
    const auto amplitude = [&] {
        const double x = simulation.positions()[2].z - x0, v = simulation.velocities()[2].z;
        return std::sqrt(x * x + v * v / g);
    };
    // Of a step of finite length the sum depends on where in its swing it is; means of two seconds do not.
    const auto mean = [&] {
        double sum = 0;
        for (int k = 0; k < 40; ++k) {
            simulation.advance(1.0 / 20);
            sum += amplitude();
        }
        return sum / 40;
    };
    simulation.advance(1);
    const double before = mean();
    simulation.advance(18);
    const double rate = std::log(before / mean()) / 20, theory = g * g / (20.0 * 20 * 20) / 4;
    RecordProperty("rate", std::to_string(rate));
    EXPECT_NEAR(rate, theory, 0.1 * theory);
}

/// rad from straight down, of a pendulum of one link of 1 m after a second.
double angle_after(std::uint32_t order, std::uint32_t substeps)
{
    Scene scene = strip(2, 1, order);
    test::converge(scene);
    scene.cloth_handle(0)->springs.structural.compliance = 1e-8;
    scene.time.substeps = substeps;
    Simulation simulation(scene, test::on(Backend::reference));
    const auto x = simulation.positions();
    const Vec3d top = to_double(x[0]);  // it stays
    for (int k = 0; k < 60; ++k) simulation.advance(frame);
    const Vec3d d = to_double(simulation.positions()[2]) - top;
    return std::atan2(d.z, -d.y);
}

/// The same by its equation of motion, a'' = -g sin a.
double exact_angle()
{
    double angle = 1, speed = 0;
    constexpr int steps = 10'000;
    constexpr double h = 1.0 / steps;
    const auto pull = [](double a) { return -g * std::sin(a); };
    for (int k = 0; k < steps; ++k) {  // Runge and Kutta's
        const double k1 = speed, l1 = pull(angle), k2 = speed + h / 2 * l1, l2 = pull(angle + h / 2 * k1),
                     k3 = speed + h / 2 * l2, l3 = pull(angle + h / 2 * k2), k4 = speed + h * l3,
                     l4 = pull(angle + h * k3);
        angle += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        speed += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
    }
    return angle;
}

TEST(SecondOrder, HalfTheStepLeavesAQuarterOfTheError)
{
    const double exact = exact_angle();
    for (const std::uint32_t order : {1u, 2u}) {
        const double coarse = std::abs(std::abs(angle_after(order, 2)) - std::abs(exact)),
                     fine = std::abs(std::abs(angle_after(order, 4)) - std::abs(exact));
        EXPECT_NEAR(coarse / fine, order == 1 ? 2 : 4, order == 1 ? 0.2 : 0.4) << order << ", " << coarse;
    }
    EXPECT_LT(std::abs(std::abs(angle_after(2, 2)) - std::abs(exact)), 1e-3);
}

TEST(SecondOrder, AirTakesWhatItTakesToSecondOrder)
{
    for (const std::uint32_t substeps : {1u, 2u}) {
        Scene scene = strip(6, 0, 2);
        test::converge(scene);
        scene.gravity = {};
        scene.time.substeps = substeps;
        scene.cloth_handle(0)->pins.clear();
        scene.cloth_handle(0)->damping = 2;  // 1/s
        scene.cloth_handle(0)->velocity = {1, 0, 0};
        Simulation simulation(scene, test::on(Backend::reference));
        for (int k = 0; k < 60; ++k) simulation.advance(frame);
        // Against exp(-d t): the first step, Euler's, leaves (d h)^2 / 2, which BDF2 carries on as 3/2 of it;
        // and BDF2 loses (d h)^2 d t / 3 more. What is of first order would be 1 / h of that.
        const double h = frame / substeps, relative = simulation.velocities()[5].x / std::exp(-2.0) - 1;
        EXPECT_NEAR(relative / (h * h), 3 - 8.0 / 3, 0.5) << substeps;
    }
}

Cloth triangle(double density)
{
    Cloth cloth = Cloth::mesh({.vertices = {{0, 0, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}}, .triangles = {{0, 1, 2}}},
                              {.density = density});
    cloth.springs = {};
    cloth.springs.structural = {0, 0};
    cloth.springs.shear.role = cloth.springs.bend.role = SpringRole::off;
    cloth.damping = 0;
    return cloth;
}

TEST(SecondOrder, DampersOfAFirstStepAreEulers)
{
    // A triangle grows evenly while it falls, so that no spring turns.
    const auto speed = [](std::uint32_t order, Backend backend) {
        Scene scene;
        scene.integrator = Integrator::implicit_euler;
        scene.newton_multigrid.order = order;
        test::converge(scene);
        scene.add(triangle(0.6));
        scene.cloth_handle(0)->springs.structural = {1, 0.02};
        scene.time.substeps = 1;
        Simulation simulation(scene, test::on(backend));
        State state = simulation.state();
        state.cloths[0].velocities = {{-0.1f, 0, -0.1f}, {0.2f, 0, -0.1f}, {-0.1f, 0, 0.2f}};
        simulation.set_state(state);
        simulation.advance(frame);
        return double{simulation.velocities()[1].x};
    };
    for (const Backend backend : {Backend::reference, Backend::cpu}) {
        EXPECT_LT(speed(1, backend), 0.18) << "dampers do nothing";
        EXPECT_NEAR(speed(2, backend), speed(1, backend), 1e-6) << name_of(backend);
    }
}

/// A triangle that the air stops, m/s along the wind after a tenth of a second; by theory u / (1 + r u t) of
/// its speed u against the air, r = 1/2 rho C_d / density. It moves as one piece.
double speed_in_air(std::uint32_t order, std::uint32_t substeps, double density, double speed, int frames)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.newton_multigrid.order = order;
    test::converge(scene);
    scene.gravity = {};
    scene.time.substeps = substeps;
    scene.air = {.velocity = {}, .density = 1.2, .drag = 1, .lift = 0};
    scene.add(triangle(density));
    scene.cloth_handle(0)->velocity = {0, speed, 0};
    Simulation simulation(scene, test::on(Backend::reference));
    for (int k = 0; k < frames; ++k) simulation.advance(frame);
    return double{simulation.velocities()[0].y};
}

TEST(SecondOrder, WindIsThatAtTheEndOfAStep)
{
    constexpr double density = 0.6, speed = 4, rate = 0.5 * 1.2 / density,
                     exact = speed / (1 + rate * speed * 0.1);
    for (const std::uint32_t order : {1u, 2u}) {
        const double coarse = speed_in_air(order, 4, density, speed, 6) - exact,
                     fine = speed_in_air(order, 8, density, speed, 6) - exact;
        EXPECT_NEAR(coarse / fine, order == 1 ? 2 : 4, order == 1 ? 0.2 : 0.4) << order << ", " << coarse;
    }
}

TEST(SecondOrder, StrongWindIsNoWorseThanByEuler)
{
    // The air takes 1.9 of the speed in the first step: Euler turns it round and comes to rest, and what is
    // taken for a line through two such forces would be unstable from 4/3 on.
    constexpr double density = 0.05, speed = 9.5;
    EXPECT_LT(std::abs(speed_in_air(2, 1, density, speed, 60)), speed / 8);
}

/// A swinging sheet, or an irregular mesh.
Scene swinging(bool mesh)
{
    Scene scene = sheet(9, 2);
    if (!mesh) return scene;
    const Springs springs = scene.cloth(0).springs;
    Cloth cloth = Cloth::mesh(test::irregular_mesh(7, 9), {.density = 0.3});
    cloth.springs = springs;
    cloth.damping = 0;
    cloth.pin(std::uint32_t{0});
    *scene.cloth_handle(0) = cloth;
    return scene;
}

TEST(SecondOrder, AStateGoesOnFromWhereItWas)
{
    for (const bool mesh : {false, true})
        for (const bool meets : {false, true})
            for (const Backend backend : {Backend::cpu, Backend::vulkan}) {
                Scene scene = swinging(mesh);
                if (meets) scene.add(Sphere{.centre = {0, -0.3, 0.2}, .radius = 0.2, .friction = 0.4});
                Simulation one(scene, test::on(backend)), other(scene, test::on(backend));
                for (int k = 0; k < 20; ++k) one.advance(frame);
                other.set_state(one.state());
                for (int k = 0; k < 3; ++k) one.advance(frame), other.advance(frame);
                EXPECT_EQ(other.state_hash(), one.state_hash())
                    << name_of(backend) << (mesh ? ", mesh" : "") << (meets ? ", sphere" : "");
            }
}

TEST(SecondOrder, AStateWithoutMemoryGoesOnByEuler)
{
    for (const bool mesh : {false, true}) {
        Scene scene = swinging(mesh), first = swinging(mesh);
        for (Scene* each : {&scene, &first}) {  // by penalty, nothing else is remembered
            each->newton_multigrid.enforcement = Enforcement::penalty;
            test::converge(*each);
        }
        first.newton_multigrid.order = 1;
        Simulation bdf2(scene, test::on(Backend::reference)), euler(first, test::on(Backend::reference));
        for (int k = 0; k < 10; ++k) bdf2.advance(frame);
        State state = bdf2.state();
        state.memory.clear();
        euler.set_state(state);
        euler.advance(frame);
        Simulation anew(scene, test::on(Backend::reference));
        anew.set_state(state);
        anew.advance(frame);
        bdf2.advance(frame);
        EXPECT_LT(test::largest_difference(anew.positions(), euler.positions()), 1e-6);
        EXPECT_GT(test::largest_difference(bdf2.positions(), euler.positions()), 3e-4);
    }
}

TEST(SecondOrder, AStepOfAnotherLengthIsEulers)
{
    // One node falls. A first step of h has v = g h, as all of Euler's; after one of h, BDF2 is exact for a
    // speed that grows evenly, and for a step of another length v = (h + h') g still, but places are Euler's.
    Scene scene = strip(2, 0, 2);
    scene.cloth_handle(0)->pins.clear();
    const auto fallen = [&](double first, double second) {
        Simulation simulation(scene, test::on(Backend::cpu));
        const double y = simulation.positions()[0].y;
        simulation.advance(first);
        simulation.advance(second);
        EXPECT_NEAR(simulation.velocities()[0].y, -g * (first + second), 1e-5);
        return y - simulation.positions()[0].y;
    };
    const double h = frame;
    // x1 = g h^2, v1 = g h; x2 = 4/3 x1 + 2/3 h 2 g h, and by Euler x1 + h' (v1 + h' g).
    EXPECT_NEAR(fallen(h, h), (4.0 / 3 + 4.0 / 3) * g * h * h, 1e-6);
    const double a = 0.6 * h, b = 0.8 * h;
    EXPECT_NEAR(fallen(a, b), g * (a * a + b * (a + b)), 1e-6);
}

TEST(SecondOrder, ANodeNearAColliderMakesStepsOfEuler)
{
    // Thrown up at 1 m/s from 1 cm above a plane: within the 3.3 cm that it looks ahead. The second step
    // leads to 2 h v - 3 g h^2 by Euler, and to 2 h v - 8/3 g h^2 by BDF2.
    const double h = frame;
    for (const bool plane : {true, false}) {
        Scene scene = sheet(4, 2);
        Cloth& cloth = *scene.cloth_handle(0);
        cloth.pins.clear();
        cloth.rotation = {};
        cloth.position = {0, cloth.thickness + 0.01, 0};
        cloth.velocity = {0, 1, 0};
        if (plane) scene.add(Plane{});
        Simulation simulation(scene, test::on(Backend::cpu));
        const double y = simulation.positions()[5].y;
        simulation.advance(h);
        simulation.advance(h);
        EXPECT_NEAR(simulation.positions()[5].y - y, 2 * h - (plane ? 3 : 8.0 / 3) * g * h * h, 1e-6);
    }
}

TEST(SecondOrder, ANodeThatIsStoppedHasTheVelocityOfItsWay)
{
    // At rest 1 mm above a plane, so that nothing is said to be near, a hand pulls it through. It is stopped
    // after 1 mm, and t / (2/3 h) would be half as much again.
    Scene scene = sheet(4, 2);
    scene.gravity = {};
    Cloth& cloth = *scene.cloth_handle(0);
    cloth.pins.clear();
    cloth.rotation = {};
    cloth.position = {0, cloth.thickness + 0.001, 0};
    scene.add(Plane{});
    Simulation simulation(scene, test::on(Backend::cpu));
    for (int k = 0; k < 3; ++k) simulation.advance(frame);
    const Vec3d before = to_double(simulation.positions()[0]);
    simulation.grab(0, 0, {before.x, -0.05, before.z}, 1000, 0);
    simulation.advance(frame);
    const double way = double{simulation.positions()[0].y} - before.y;
    EXPECT_NEAR(way, -0.001, 3e-4);
    EXPECT_NEAR(double{simulation.velocities()[0].y}, way / frame, 0.02 * 0.001 / frame);
}

TEST(SecondOrder, WhatFallsOnAPlaneLiesAsStillAsByEuler)
{
    for (const std::uint32_t order : {1u, 2u}) {
        Scene scene = sheet(24, order);
        scene.cloth_handle(0)->pins.clear();
        scene.cloth_handle(0)->rotation = {5, 0, 3};
        scene.cloth_handle(0)->position = {0, 0.4, 0};
        scene.add(Plane{.friction = 0.3});
        Simulation simulation(scene, test::on(Backend::cpu));
        for (int k = 0; k < 30; ++k) simulation.advance(frame);
        test::Largest highest;
        for (int k = 0; k < 90; ++k) {
            simulation.advance(frame);
            for (const Vec3& x : simulation.positions()) highest.add(double{x.y});
        }
        EXPECT_LT(highest.value(), 0.02) << "it bounces";
        EXPECT_LT(simulation.report().measures.kinetic_energy, 2e-4) << "J, " << order;
    }
}

TEST(SecondOrder, WhatSlidesStopsWhereItDoesByEuler)
{
    double ends[2] = {};
    for (const std::uint32_t order : {1u, 2u}) {
        Scene scene = sheet(10, order);
        Cloth& cloth = *scene.cloth_handle(0);
        cloth.pins.clear();
        cloth.rotation = {};
        cloth.position = {0, cloth.thickness, 0};
        cloth.velocity = {2, 0, 0};
        scene.add(Plane{.friction = 0.3});
        Simulation simulation(scene, test::on(Backend::cpu));
        for (int k = 0; k < 90; ++k) simulation.advance(frame);
        for (const Vec3& x : simulation.positions()) ends[order - 1] += x.x / 100;
        EXPECT_LT(simulation.report().measures.max_speed, 2e-3);
    }
    EXPECT_NEAR(ends[1], ends[0], 1e-3);
    EXPECT_NEAR(ends[1], 2 * 2 / (2 * 0.3 * g), 0.03);  // m, as a block goes
}

TEST(SecondOrder, AHandHoldsWhatHangsFromIt)
{
    Scene scene = sheet(7, 2);
    scene.cloth_handle(0)->pins.clear();
    scene.cloth_handle(0)->damping = 3;
    Simulation simulation(scene, test::on(Backend::cpu));
    const Vec3d target = to_double(simulation.positions()[24]);
    constexpr double stiffness = 200;  // N/m
    for (int k = 0; k < 600; ++k) {
        simulation.grab(0, 24, target, stiffness, 1);
        simulation.advance(frame);
    }
    EXPECT_NEAR(target.y - double{simulation.positions()[24].y}, 0.3 * g / stiffness, 0.0005);
}

TEST(SecondOrder, PinsThatMoveTakeTheClothAlong)
{
    Scene scene = sheet(7, 2);
    scene.gravity = {};
    scene.cloth_handle(0)->velocity = {0.5, 0, 0};
    scene.cloth_handle(0)->pins = {{Edge::top, {{.time = 0}, {.time = 10, .position = {5, 0, 0}}}}};
    Simulation simulation(scene, test::on(Backend::cpu));
    const auto start = simulation.positions();
    const double x0 = start[30].x, top = start[0].x;
    for (int k = 0; k < 60; ++k) simulation.advance(frame);
    EXPECT_NEAR(simulation.positions()[0].x - top, 0.5, 1e-5);
    EXPECT_NEAR(simulation.positions()[30].x - x0, 0.5, 1e-4);
    for (const Vec3& v : simulation.velocities()) EXPECT_NEAR(v.x, 0.5, 1e-3);
}

}  // namespace
}  // namespace pliant
