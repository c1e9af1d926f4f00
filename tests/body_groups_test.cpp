// Bodies that are stepped together as one model: each moves as it would alone, with its own forces and
// material, and is measured at its own place.
#include <gtest/gtest.h>

#include "pliant/pliant.hpp"
#include "test_cloths.hpp"

namespace pliant {
namespace {

/// A ball of 1 kg at a place, a metre from others, without gravity.
Cloth ball_at(Vec3d place)
{
    Cloth body =
        Cloth::soft_body(icosphere_mesh({.radius = 0.4, .frequency = 3}), {}, {.node_mass = 1.0 / 92});
    body.springs.structural = {500, 0.1};
    body.damping = 0;
    body.position = place;
    return body;
}

Scene weightless(std::initializer_list<Cloth> bodies)
{
    Scene scene;
    scene.method = Method::volume;
    scene.gravity = {};
    scene.time.substeps = 10;
    for (const Cloth& body : bodies) scene.add(body);
    return scene;
}

void expect_as_alone(const Scene& together, double tolerance)
{
    for (const Backend backend : {Backend::reference, Backend::cpu}) {
        Simulation all(together, test::on(backend));
        for (int k = 0; k < 10; ++k) all.advance(1 / 60.0);
        for (std::size_t c = 0; c < together.cloth_count(); ++c) {
            Scene alone = weightless({together.cloth(c)});
            alone.time = together.time;
            alone.colliders = together.colliders;
            Simulation one(alone, test::on(backend));
            for (int k = 0; k < 10; ++k) one.advance(1 / 60.0);
            ASSERT_TRUE(all.report().finite && one.report().finite);
            const auto x = all.positions(c), y = one.positions();
            ASSERT_EQ(x.size(), y.size());
            for (std::size_t i = 0; i < x.size(); ++i) {
                const Vec3d d = to_double(x[i]) - to_double(y[i]);
                ASSERT_LE(std::sqrt(dot(d, d)), tolerance)
                    << name_of(backend) << ", body " << c << ", node " << i;
            }
        }
    }
}

TEST(BodyGroups, ATorqueTurnsTheBodyThatItActsOn)
{
    Cloth second = ball_at({2, 0, 0});
    second.body->forces = {{{{1, -1, -1}, {3, 1, 1}}, {0, 1, 0}, {0, 3, 0}}};
    expect_as_alone(weightless({ball_at({0, 0, 0}), second}), 2e-5);
}

TEST(BodyGroups, EachHasItsOwnMaterial)
{
    Cloth soft = ball_at({0, 0, 0}), stiff = ball_at({2, 0, 0});
    stiff.springs.structural.stiffness = 5000;
    // Its stable step is 0.8 ms; a diverging body would stop the others, too.
    for (Cloth* body : {&soft, &stiff})  // so that the springs are stretched
        body->body->forces = {{{{-9, 0.2, -9}, {9, 9, 9}}, {0, 20, 0}, {}}};
    Scene together = weightless({soft, stiff});
    together.time.substeps = 40;
    expect_as_alone(together, 2e-5);
}

TEST(BodyGroups, EachMeetsTheCollidersWhereTheyAre)
{
    // With two materials, and thus two models with different origins; only the first is above the sphere.
    Cloth first = ball_at({0, 0, 0}), second = ball_at({4, 0, 0});
    second.springs.structural.stiffness = 400;
    first.velocity = second.velocity = {0, -1, 0};
    Scene together = weightless({first, second});
    together.add(Sphere{.centre = {0, -0.65, 0}, .radius = 0.2});
    expect_as_alone(together, 2e-5);
}

TEST(BodyGroups, PotentialEnergyKnowsHowHighABodyIs)
{
    for (const Backend backend : {Backend::reference, Backend::cpu}) {
        Scene scene = weightless({ball_at({0, 5, 0}), ball_at({0, 8, 0})});
        scene.gravity = {0, -9.81, 0};
        Simulation simulation(scene, test::on(backend));
        EXPECT_NEAR(simulation.report().measures.potential_energy, 9.81 * (5 + 8), 1e-3) << name_of(backend);
    }
}

}  // namespace
}  // namespace pliant
