// Nodes that start inside a collider, or that a collider jumps onto, rise slowly instead of being thrown.
#include <gtest/gtest.h>

#include <cmath>

#include "pliant/mesh_generators.hpp"
#include "pliant/simulation.hpp"
#include "test_differences.hpp"
#include "test_runners.hpp"
#include "test_scenes.hpp"

namespace pliant {
namespace {

constexpr double g = 9.81, frame = 1.0 / 60;

struct Way {
    Backend backend;
    Method method;
};
class StartInside : public testing::TestWithParam<Way> {};
INSTANTIATE_TEST_SUITE_P(
    Ways, StartInside,
    testing::Values(Way{Backend::reference, Method::mass_spring}, Way{Backend::reference, Method::constraint},
                    Way{Backend::cpu, Method::mass_spring}, Way{Backend::cpu, Method::constraint},
                    Way{Backend::cpu, Method::acad}, Way{Backend::vulkan, Method::mass_spring},
                    Way{Backend::vulkan, Method::constraint}),
    [](const auto& way) {
        return std::string(name_of(way.param.backend)) + "_" + std::string(name_of(way.param.method));
    });

std::uint32_t nodes_of(Backend backend) { return backend == Backend::cpu ? 24 : 9; }

Scene sheet_at(const Way& way, Vec3d position, double edge)
{
    Scene scene;
    scene.method = way.method;
    const std::uint32_t n = nodes_of(way.backend);
    scene.add(Cloth::sheet({.rows = n, .columns = n, .width = edge, .height = edge, .density = 0.3}));
    scene.cloth_handle(0)->position = position;
    return scene;
}

struct Motion {
    double energy = 0, stretch = 0, height = -1e30;  // the largest of each: J, of kinetic energy; m
};
Motion largest_of(Simulation& simulation, int frames)
{
    Motion most;
    for (int k = 0; k < frames; ++k) {
        simulation.advance(frame);
        most.energy = std::max(most.energy, simulation.report().measures.kinetic_energy);
        most.stretch = std::max(most.stretch, simulation.report().measures.max_stretch);
        for (const Vec3& x : simulation.positions()) most.height = std::max(most.height, double{x.y});
    }
    EXPECT_TRUE(simulation.report().finite);
    return most;
}

// A ball pokes 25 cm through a sheet. Nodes rise at 1 m/s at most, so the cloth's energy is at most m v^2 /
// 2, plus m g times the 25 cm from sliding off; it flies at most v^2 / 2g higher than the ball's top.
TEST_P(StartInside, ABallInASheetDoesNotThrowIt)
{
    Scene scene = sheet_at(GetParam(), {0, 1, 0}, 0.8);
    constexpr double top = 1.25, mass = 0.3 * 0.64, speed = 1;
    scene.add(Sphere{.centre = {0, 0.95, 0}, .radius = 0.3});
    Simulation simulation(scene, test::on(GetParam().backend));
    ASSERT_GT(simulation.report().measures.max_penetration, 0.2);
    const bool slow = GetParam().backend == Backend::vulkan;
    const Motion most = largest_of(simulation, slow ? 20 : 60);
    EXPECT_LT(most.energy, mass * (speed * speed / 2 + g * 0.25));
    EXPECT_LT(most.height, top + speed * speed / (2 * g));
    EXPECT_LT(most.stretch, 0.5);
    // It does come out. An inextensible cloth takes longer: it must slide over the ball as a whole.
    if (!slow) {
        EXPECT_LT(simulation.report().measures.max_penetration,
                  GetParam().method == Method::constraint ? 0.125 : 0.05);
        EXPECT_GT(most.height, 1.1);
    }
}

// A sheet that is completely inside a ball: springs keep it there, or it comes out. It stays calm in either
// case.
TEST_P(StartInside, ABallAroundASheetLeavesItCalm)
{
    Scene scene = sheet_at(GetParam(), {0, 1, 0}, 0.8);
    scene.add(Sphere{.centre = {0, 1, 0}, .radius = 0.7});
    scene.add(Plane{});
    Simulation simulation(scene, test::on(GetParam().backend));
    const Motion most = largest_of(simulation, GetParam().backend == Backend::vulkan ? 20 : 60);
    EXPECT_LT(most.energy, 0.3 * 0.64 * g * 1.7);  // a fall from the ball's top
    // At most 1000 m/s2 outward on half of the cloth, against the springs that cross its middle.
    EXPECT_LT(most.stretch, 0.5);
}

// A ball that jumps into a hanging sheet is no different.
TEST_P(StartInside, ABallThatJumpsIntoASheetDoesNotThrowIt)
{
    Scene scene = sheet_at(GetParam(), {0, 0, 0}, 0.8);
    scene.cloth_handle(0)->rotation = {90, 0, 0};
    scene.cloth_handle(0)->pin(Edge::top);
    scene.add(Sphere{
        .centre = {0, 0, 1}, .radius = 0.2, .keyframes = {{0.1, {}, {}}, {0.1001, {0, 0, -0.95}, {}}}});
    Simulation simulation(scene, test::on(GetParam().backend));
    const Motion most = largest_of(simulation, GetParam().backend == Backend::vulkan ? 12 : 40);
    EXPECT_LT(most.energy, 0.3 * 0.64 * 0.5);  // 1 m/s
    EXPECT_LT(most.stretch, 0.5);
}

// Pins inside of a collider stay, and what hangs on them does not fly.
TEST_P(StartInside, PinsInsideStayThere)
{
    Scene scene = sheet_at(GetParam(), {0, 0, 0.4}, 0.8);
    scene.cloth_handle(0)->pin(Edge::top);
    scene.add(Box{.centre = {0, 0, 0}, .size = {1, 0.1, 0.2}});
    Simulation simulation(scene, test::on(GetParam().backend));
    const Vec3 pin = simulation.positions()[0];
    const Motion most = largest_of(simulation, GetParam().backend == Backend::vulkan ? 12 : 60);
    EXPECT_EQ(simulation.positions()[0], pin);
    EXPECT_LT(most.energy, 0.3 * 0.64 * (0.5 + g * 0.4));
    EXPECT_LT(most.stretch, 0.5);
}

// Who is let out is part of the state.
TEST_P(StartInside, GoesOnFromAState)
{
    if (GetParam().backend == Backend::reference)
        GTEST_SKIP() << "states are in float, and it steps in double";
    Scene scene = sheet_at(GetParam(), {0, 0.05, 0}, 0.3);
    scene.add(Sphere{.centre = {0, 0, 0}, .radius = 0.1});
    Simulation simulation(scene, test::on(GetParam().backend)), other(scene, test::on(GetParam().backend));
    for (int k = 0; k < 3; ++k) simulation.advance(frame);
    const State state = simulation.state();
    ASSERT_EQ(state.lets_rise, std::vector<std::uint8_t>{1});
    other.set_state(state);
    for (int k = 0; k < 2; ++k) simulation.advance(frame), other.advance(frame);
    EXPECT_EQ(simulation.state_hash(), other.state_hash());
    State unknown = state;
    unknown.lets_rise.clear();
    other.set_state(unknown);
    for (int k = 0; k < 2; ++k) other.advance(frame);
    EXPECT_EQ(simulation.state_hash(), other.state_hash());
}

TEST(StartInsideBody, ABodyInTheGroundIsNotThrown)
{
    Scene scene;
    scene.method = Method::volume;
    scene.add(Cloth::soft_body(icosphere_mesh({.radius = 0.3, .frequency = 6})));
    scene.cloth_handle(0)->position = {0, 0.1, 0};  // 20 cm of it are in the ground
    scene.add(Plane{});
    Simulation simulation(scene, test::on(Backend::cpu));
    constexpr double mass = 0.3 * 4 * 3.1416 * 0.09;
    const Motion most = largest_of(simulation, 120);
    EXPECT_LT(most.energy, mass * 2);  // 2 m/s
    EXPECT_LT(simulation.report().measures.max_penetration, 0.01);
}

// --- What is said of it ---

std::string all_warnings(const Scene& scene)
{
    std::string text;
    for (const std::string& sentence : Simulation(scene, test::on(Backend::cpu)).warnings())
        text += sentence + "; ";
    return text;
}

TEST(StartWarnings, CountTheNodesInACollider)
{
    // 5 x 5 nodes, 25 cm apart: the ball has the middle and its four neighbours, the deepest by 0.3 m.
    Scene scene;
    scene.add(Cloth::sheet({.rows = 5, .columns = 5}));
    scene.add(Plane{.point = {0, -1, 0}});
    scene.add(Sphere{.centre = {0, 0, 0}, .radius = 0.3});
    EXPECT_NE(all_warnings(scene).find("'cloth': 5 nodes start inside colliders[1], the deepest by 0.3 m"),
              std::string::npos)
        << all_warnings(scene);
    scene.cloth_handle(0)->pin(std::uint32_t{12});  // a pin inside is meant
    EXPECT_NE(all_warnings(scene).find("4 nodes start inside colliders[1], the deepest by 0.05 m"),
              std::string::npos)
        << all_warnings(scene);
}

TEST(StartWarnings, SayNothingOfWhatLiesOnASurface)
{
    Scene scene;
    scene.add(Cloth::sheet({.rows = 5, .columns = 5}));
    scene.add(Plane{});
    EXPECT_EQ(all_warnings(scene), "");
}

}  // namespace
}  // namespace pliant
