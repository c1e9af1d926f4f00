// The effect of a hand on a node, and saving and restoring states.
#include <gtest/gtest.h>

#include <cmath>

#include "backend/vulkan/device.hpp"
#include "test_cloths.hpp"
#include "test_differences.hpp"
#include "test_errors.hpp"

namespace pliant {
namespace {

constexpr double g = 9.81;

using test::on;

const Backend all_backends[] = {Backend::cpu, Backend::vulkan, Backend::reference};

/// Four unconnected nodes of 0.02 kg each.
Scene loose_nodes()
{
    Scene scene;
    Cloth cloth = Cloth::sheet({.rows = 2, .columns = 2, .node_mass = 0.02});
    cloth.springs = {{0, 0}, {0, 0}, {0, 0}};
    cloth.damping = 0;
    cloth.pin(std::uint32_t{3});
    scene.add(cloth);
    scene.time.frame_rate = 60;
    scene.time.substeps = 4;
    return scene;
}

TEST(Grab, FollowsTheImplicitStepOfASpringToTheHand)
{
    const Scene scene = loose_nodes();
    const double m = 0.02, k = 37, c = 0.4, dt = 1.0 / 240;
    const Vec3d target{0.2, 0.7, -0.3};
    for (const Backend backend : all_backends) {
        Simulation simulation(scene, on(backend));
        simulation.grab(0, 0, target, k, c);
        Vec3d x{-0.5, 0, -0.5}, v{};
        for (int frame = 0; frame < 60; ++frame) {
            simulation.advance(1.0 / 60);
            for (int step = 0; step < 4; ++step) {
                const Vec3d f = (target - x) * k + Vec3d{0, -m * g, 0};
                v = (v * m + f * dt) * (1 / (m + c * dt + k * dt * dt));
                x = x + v * dt;
            }
            const Vec3d d = to_double(simulation.positions()[0]) - x;
            // Positions of up to 1 m are rounded by 3e-8 m in each of up to 240 steps, velocities of up to 10
            // m/s by 5e-7 m/s, which last for 1 / 240 s each: at most 1e-5 m if nothing cancels and nothing
            // damps.
            ASSERT_LE(std::sqrt(dot(d, d)), 1e-5) << name_of(backend) << ", frame " << frame;
        }
        EXPECT_EQ(simulation.report().validation_messages, 0u);
    }
}

TEST(Grab, AtRestTheSpringCarriesTheNode)
{
    const double m = 0.02, k = 37;
    Scene scene = loose_nodes();
    scene.cloth_handle(0).pin(std::uint32_t{0}).pin(std::uint32_t{2});
    Simulation simulation(scene, on(Backend::cpu));
    simulation.grab(0, 1, {0.5, 0.4, -0.5}, k, 1.0);
    simulation.advance(5);  // e-fold of the damping: 2 m / c = 0.04 s
    EXPECT_NEAR(double{simulation.positions()[1].y}, 0.4 - m * g / k, 1e-6);
    // After release it falls freely, by g dt per step.
    const double before = double{simulation.velocities()[1].y};
    simulation.release();
    simulation.advance(1.0 / 60);
    EXPECT_NEAR(double{simulation.velocities()[1].y}, before - g / 60, 1e-6);
    // Nothing else moves, so this is the node's own motion, with its own mass.
    const double speed = double{simulation.velocities()[1].y};
    EXPECT_NEAR(simulation.report().measures.kinetic_energy, 0.5 * m * speed * speed,
                1e-6 * m * speed * speed);
}

TEST(Grab, AirTakesNothingOfThePull)
{
    const double m = 0.02, k = 37;
    for (const Method method : {Method::mass_spring, Method::constraint}) {
        Scene scene = loose_nodes();
        scene.method = method;
        for (SpringParameters* springs :
             {&scene.cloth_handle(0)->springs.structural, &scene.cloth_handle(0)->springs.shear})
            springs->role = SpringRole::off;
        scene.cloth_handle(0).pin(std::uint32_t{0}).pin(std::uint32_t{2});
        scene.cloth_handle(0)->damping = 5;
        Simulation simulation(scene, on(Backend::cpu));
        simulation.grab(0, 1, {0.5, 0.4, -0.5}, k, 1.0);
        for (int frame = 0; frame < 300; ++frame) simulation.advance(1.0 / 60);
        // In each step a node at rest falls by g dt and is pulled up by as much; 1e-5 m: the spacing of
        // floats at 0.4 m and the settling of 5 s at 5 1/s.
        EXPECT_NEAR(double{simulation.positions()[1].y}, 0.4 - m * g / k, 1e-5) << name_of(method);
    }
}

TEST(Grab, APinnedNodeStays)
{
    Simulation simulation(loose_nodes(), on(Backend::cpu));
    const Vec3 before = simulation.positions()[3];
    simulation.grab(0, 3, {0, 2, 0}, 1000, 1);
    simulation.advance(0.1);
    EXPECT_EQ(simulation.positions()[3], before);
}

/// A sheet that only the hand supports.
Scene free_sheet(Method method)
{
    Scene scene;
    scene.add(test::flat_sheet(9, 11, 0.5, 0.5));
    scene.cloth_handle(0)->damping = 2;
    scene.method = method;
    return scene;
}

TEST(Grab, CarriesAWholeSheetWithEveryMethod)
{
    const double k = 60, weight = 0.3 * 0.5 * 0.5 * g;
    for (const Method method : {Method::mass_spring, Method::constraint, Method::acad}) {
        Scene scene = free_sheet(method);
        scene.newton_multigrid.newton_tolerance = 1e-3;  // of the load that a step may leave uncarried
        Simulation simulation(scene, on(Backend::cpu));
        simulation.grab(0, 49, {0, 0, 0}, k, 1);
        for (int frame = 0; frame < 900; ++frame) simulation.advance(1.0 / 60);
        // Equilibrium of the whole: 15 s at 2 1/s leave nothing of the swinging; 20 times the solver's
        // tolerance.
        EXPECT_NEAR(double{simulation.positions()[49].y}, -weight / k, 0.02 * weight / k) << name_of(method);
    }
}

TEST(Grab, GivesTheSameBitsOnCpuAndVulkan)
{
    for (const Method method : {Method::mass_spring, Method::constraint, Method::acad}) {
        std::uint64_t hashes[2];
        for (const bool on_vulkan : {false, true}) {
            Simulation simulation(free_sheet(method), on(on_vulkan ? Backend::vulkan : Backend::cpu));
            for (int frame = 0; frame < 4; ++frame) {
                if (frame < 3) simulation.grab(0, 7, {0.01 * frame, 0.3, 0}, 500, 2);
                if (frame == 3) simulation.release();
                simulation.advance(1.0 / 240);
            }
            EXPECT_TRUE(simulation.report().finite);
            EXPECT_EQ(simulation.report().validation_messages, 0u);
            hashes[on_vulkan] = simulation.state_hash();
        }
        EXPECT_EQ(hashes[0], hashes[1]) << name_of(method);
    }
}

TEST(Grab, MovesABodyInTheOrderOfItsMesh)
{
    const Scene scene = read_scene("free_fall", {"bodies[0].icosphere.frequency=4"});
    Simulation simulation(scene, on(Backend::cpu));
    const Vec3d start = to_double(simulation.positions()[17]);
    const Vec3d up = start + Vec3d{0, 1.5, 0};
    simulation.grab(0, 17, up, 20000, 200);
    for (int frame = 0; frame < 100; ++frame) simulation.advance(1 / scene.time.frame_rate);
    std::size_t highest = 0;
    for (std::size_t i = 0; i < simulation.positions().size(); ++i)
        if (simulation.positions()[i].y > simulation.positions()[highest].y) highest = i;
    EXPECT_EQ(highest, 17u);
    EXPECT_GT(double{simulation.positions()[17].y}, start.y + 0.2);
}

TEST(Grab, RefusesWhatCannotBe)
{
    Simulation simulation(loose_nodes(), on(Backend::cpu));
    EXPECT_ERROR(simulation.grab(0, 4, {}, 1, 1), bad_usage, "no node 4 of cloth 0");
    EXPECT_ERROR(simulation.grab(1, 0, {}, 1, 1), bad_usage, "no node 0 of cloth 1");
    EXPECT_ERROR(simulation.grab(0, 0, {}, -1, 1), bad_usage, "stiffness");
    EXPECT_ERROR(simulation.grab(0, 0, {}, 1, std::nan("")), bad_usage, "damping");
    EXPECT_ERROR(simulation.grab(0, 0, {0, INFINITY, 0}, 1, 1), bad_usage, "target");
}

TEST(State, GoesOnFromWhereItWasPut)
{
    for (const Method method : {Method::mass_spring, Method::constraint})
        for (const Backend backend : {Backend::cpu, Backend::vulkan}) {
            Scene scene = free_sheet(method);
            scene.cloth_handle(0)
                ->pin(Corner::top_left)
                .pin({Edge::left, {{.time = 0}, {.time = 1, .position = {0.2, 0, 0}}}});
            Simulation one(scene, on(backend)), other(scene, on(backend));
            for (int frame = 0; frame < 10; ++frame) one.advance(1.0 / 60);
            other.set_state(one.state());
            EXPECT_EQ(other.state_hash(), one.state_hash());
            EXPECT_EQ(other.time(), one.time());
            EXPECT_EQ(other.report().measures.max_stretch, one.report().measures.max_stretch);
            for (int frame = 0; frame < 10; ++frame) one.advance(1.0 / 60), other.advance(1.0 / 60);
            EXPECT_TRUE(one.report().finite);
            EXPECT_EQ(other.state_hash(), one.state_hash()) << name_of(method) << ", " << name_of(backend);
        }
}

TEST(State, OfBodiesIsInTheOrderOfTheMesh)
{
    const Scene scene = read_scene("free_fall", {"bodies[0].icosphere.frequency=3"});
    Simulation one(scene, on(Backend::cpu)), other(scene, on(Backend::cpu));
    for (int frame = 0; frame < 20; ++frame) one.advance(1 / scene.time.frame_rate);
    other.set_state(one.state());
    // Conversion of positions to another origin and back: one rounding at 1 m.
    EXPECT_LE(test::largest_difference(one.positions(), other.positions()), 1.2e-7);
}

TEST(State, LeavesAPinWhereItStands)
{
    // Springs of a pin would feel its velocity.
    Scene scene = free_sheet(Method::mass_spring);
    scene.cloth_handle(0)->pin(Corner::top_left);
    Simulation simulation(scene, on(Backend::cpu));
    const State start = simulation.state();
    State moving = start;
    for (Vec3& v : moving.cloths[0].velocities) v = {1, 2, 3};
    simulation.set_state(moving);
    std::size_t pins = 0;
    for (std::size_t i = 0; i < start.cloths[0].positions.size(); ++i)
        if (simulation.velocities()[i] == Vec3{})
            ++pins;
        else
            EXPECT_EQ(simulation.velocities()[i], (Vec3{1, 2, 3})) << i;
    EXPECT_EQ(pins, 1u);
}

TEST(State, TakesADivergedRunUpAgain)
{
    Scene scene = free_sheet(Method::mass_spring);
    Simulation simulation(scene, on(Backend::cpu));
    const State start = simulation.state();
    for (const float bad : {std::nanf(""), INFINITY, -INFINITY}) {
        State broken = start;
        broken.cloths[0].positions[5].y = bad;
        simulation.set_state(broken);
        EXPECT_FALSE(simulation.report().finite) << bad;
        simulation.set_state(start);
        EXPECT_TRUE(simulation.report().finite) << bad;
    }
    simulation.advance(1.0 / 60);
    EXPECT_GT(simulation.report().measures.max_speed, 0.1);
}

TEST(State, RefusesAnotherScenes)
{
    Simulation simulation(loose_nodes(), on(Backend::cpu));
    State state = simulation.state();
    state.cloths[0].velocities.pop_back();
    EXPECT_ERROR(simulation.set_state(state), bad_usage, "other numbers of nodes");
    EXPECT_ERROR(simulation.set_state({}), bad_usage, "other cloths");
}

TEST(Listing, SpringsAndPinsAreThoseOfTheScene)
{
    for (const Formulation formulation : {Formulation::node_centric, Formulation::spring_list}) {
        Scene scene;
        Cloth cloth = test::flat_sheet(3, 4, 0.3, 0.2);
        cloth.formulation = formulation;
        cloth.pin(Edge::top).pin({std::uint32_t{11}, {{.time = 0}, {.time = 1}}});
        scene.add(cloth);
        Simulation simulation(scene, on(Backend::cpu));
        const auto springs = simulation.springs();
        ASSERT_EQ(springs.size(), simulation.spring_count());
        std::size_t structural = 0;
        for (const SpringListing& spring : springs) {
            const Vec3d d =
                to_double(simulation.positions()[spring.i]) - to_double(simulation.positions()[spring.j]);
            EXPECT_NEAR(std::sqrt(dot(d, d)), spring.rest_length, 1e-7);
            structural += spring.kind == SpringKind::structural;
        }
        EXPECT_EQ(structural, 3u * 3 + 2u * 4);
        const auto pins = simulation.pins();
        ASSERT_EQ(pins.size(), 5u);
        EXPECT_EQ(pins[4].node, 11u);
        EXPECT_TRUE(pins[4].moves);
        EXPECT_FALSE(pins[0].moves);
    }
}

}  // namespace
}  // namespace pliant
