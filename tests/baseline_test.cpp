// The baselines of `pliant bench` move like Pliant's reference, so they do the same work.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "bullet_cloth.hpp"
#include "pliant/mesh_generators.hpp"
#include "serial_scene.hpp"
#include "test_cloths.hpp"
#include "test_differences.hpp"
#include "test_errors.hpp"

namespace pliant {
namespace {

// Both take the same steps in the same order and differ only by rounding. The difference between Pliant's
// float backend and the reference shows how much a scene amplifies rounding. A baseline may differ by 8 times
// as much, since it adds a node's springs in another order and computes square roots differently. A baseline
// that does less work differs by orders of magnitude (last test).
constexpr double slack = 8;

constexpr double duration = 0.2;  // s: a fall of 20 cm

Scene steady(Cloth cloth, std::uint32_t steps_per_frame)
{
    Scene scene;
    scene.time = {.duration = duration, .frame_rate = 50, .substeps = steps_per_frame};
    scene.add(std::move(cloth));
    return scene;
}

/// Hangs from its upper edge, under tension everywhere, and swings against a sphere and a wall.
Scene hung_sheet(std::uint32_t rows, std::uint32_t columns)
{
    Cloth cloth = test::flat_sheet(rows, columns);
    cloth.springs = {{1000, 0.2}, {500, 0.3}, {40, 0.04}};
    cloth.damping = 1;
    cloth.rotation = {90, 0, 0};
    cloth.velocity = {0.1, 0, 0.8};
    cloth.pin(Edge::top);
    Scene scene = steady(std::move(cloth), 80);
    scene.add(Sphere{.centre = {0.1, -0.3, 0.3}, .radius = 0.25, .friction = 0.3});
    scene.add(Plane{.point = {0, 0, 0.12}, .normal = {0, 0, -1}, .friction = 0.2});
    return scene;
}

/// The final differences of a scene stepped by Pliant and by a baseline.
struct Runs {
    double apart = 0;         ///< m, of the baseline from the reference
    double rounding = 0;      ///< m, of the backend cpu from the reference
    double moved = 0;         ///< m, of the baseline from the start
    double volume_error = 0;  ///< of a body, the largest of all steps
};

double volume_error(const serial::Cloth&) { return 0; }
double volume_error(const serial::Body& body)
{
    return std::abs(serial::volume_of(body) / body.wanted_volume - 1);
}
const std::vector<serial::Node>& nodes_of(const serial::Cloth& cloth) { return cloth.nodes; }
const std::vector<serial::Node>& nodes_of(const serial::Body& body) { return body.skin.nodes; }

template <class Baseline>
Runs runs_of(const Scene& scene, Baseline baseline)
{
    Simulation exact(scene, test::on(Backend::reference)), rounded(scene, test::on(Backend::cpu));
    const auto start = exact.positions();
    const std::vector<Vec3> before(start.begin(), start.end());
    exact.advance(duration);
    rounded.advance(duration);
    test::Largest volume_errors;
    for (std::uint64_t k = 0; k < exact.report().steps; ++k) {
        serial::step(baseline, static_cast<float>(exact.step_length()));
        volume_errors.add(volume_error(baseline));
    }
    std::vector<Vec3> places;
    for (const serial::Node& node : nodes_of(baseline))
        places.push_back({node.position.x, node.position.y, node.position.z});
    return {test::largest_difference(places, exact.positions()),
            test::largest_difference(rounded.positions(), exact.positions()),
            test::largest_difference(places, before), volume_errors.value()};
}

void expect_same_motion(const Runs& runs)
{
    EXPECT_GT(runs.moved, 0.1);
    EXPECT_LT(runs.rounding, 1e-3);
    EXPECT_LE(runs.apart, slack * runs.rounding);
    std::printf("moved by %.3g m; %.3g m apart, of %.3g m allowed\n", runs.moved, runs.apart,
                slack * runs.rounding);
}

TEST(SerialCloth, SwingsAsTheReferenceDoes)
{
    const Scene scene = hung_sheet(13, 17);
    expect_same_motion(runs_of(scene, serial::cloth_of(scene)));
}

TEST(SerialCloth, OfAMeshFallsAsTheReferenceDoes)
{
    Cloth cloth = Cloth::mesh(test::irregular_mesh(12, 15), {.density = 0.3});
    cloth.springs = {{1000, 0.02}, {500, 0.03}, {10, 0.004}};
    cloth.pin(0u).pin(7u);
    const Scene scene = steady(std::move(cloth), 80);
    expect_same_motion(runs_of(scene, serial::cloth_of(scene)));
}

/// Pinned at its head and released, so that its springs stretch.
Scene hung_body()
{
    Cloth body = Cloth::soft_body(blob_mesh({.height = 0.5, .vertices = 1000}), {}, {.node_mass = 0.01});
    body.springs.structural = {200, 0.2};
    body.pin(Region{{-1, 0.15, -1}, {1, 1, 1}});
    Scene scene = steady(std::move(body), 100);
    scene.method = Method::volume;
    return scene;
}

TEST(SerialVolume, HangsAsTheReferenceDoes)
{
    const Scene scene = hung_body();
    const serial::Body start = serial::body_of(scene);
    const Runs runs = runs_of(scene, start);
    expect_same_motion(runs);
    EXPECT_LE(runs.volume_error, 1e-6);  // rounding of floats, summed in doubles
    const Runs springs_alone = runs_of(scene, start.skin);
    EXPECT_GT(springs_alone.apart, 10 * slack * runs.rounding);
}

TEST(SerialCloth, ThatDoesLessWorkIsSeen)
{
    const Scene scene = hung_sheet(13, 17);
    const std::function<void(serial::Cloth&)> savings[] = {
        [](serial::Cloth& cloth) { cloth.spheres.clear(); },
        [](serial::Cloth& cloth) { cloth.planes.clear(); },
        [](serial::Cloth& cloth) { cloth.damping = 0; },
        [](serial::Cloth& cloth) {
            for (serial::Spring& spring : cloth.springs) spring.damping = 0;
        },
        [](serial::Cloth& cloth) {
            std::erase_if(cloth.springs, [](const serial::Spring& spring) { return spring.stiffness == 40; });
        },
    };
    for (const auto& save : savings) {
        serial::Cloth cloth = serial::cloth_of(scene);
        save(cloth);
        const Runs runs = runs_of(scene, std::move(cloth));
        EXPECT_GT(runs.apart, 10 * slack * runs.rounding);
    }
}

std::vector<Vec3> after_steps(bullet::SoftBody& body, std::size_t nodes, int steps, float dt)
{
    for (int k = 0; k < steps; ++k) body.step(dt);
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < nodes; ++i) {
        const serial::Vector x = body.position(i);
        places.push_back({x.x, x.y, x.z});
    }
    return places;
}

TEST(BulletSoftBody, FallsAsAnythingThatNothingHolds)
{
    const Scene scene = steady(test::flat_sheet(7, 9), 80);
    const serial::Cloth cloth = serial::cloth_of(scene);
    const auto body = bullet::soft_body_of(cloth);
    if (!body) GTEST_SKIP() << "built without Bullet";
    constexpr float dt = 1e-3f;
    constexpr int steps = 200;
    const std::vector<Vec3> places = after_steps(*body, cloth.nodes.size(), steps, dt);
    // All nodes fall by g t^2 / 2, but for the first order of the step, g t dt / 2.
    const double fall = 9.81 * 0.5 * steps * dt * steps * dt;
    for (std::size_t i = 0; i < cloth.nodes.size(); ++i)
        EXPECT_NEAR(double{cloth.nodes[i].position.y} - double{places[i].y}, fall, 0.02 * fall);
}

/// A sheet released from the horizontal, pinned along one edge, by Pliant and by Bullet.
struct Let {
    std::vector<Vec3> start, ours, bullets;
    std::vector<serial::Spring> springs;
};
Let let_go(const std::function<void(serial::Cloth&)>& change)
{
    constexpr double time = 0.4;  // s: a quarter of a swing and more
    Cloth cloth = test::flat_sheet(7, 9);
    cloth.damping = 0;
    cloth.pin(Edge::top);
    const Scene scene = steady(std::move(cloth), 80);
    serial::Cloth bare = serial::cloth_of(scene);
    Let let;
    let.springs = bare.springs;
    for (const serial::Node& node : bare.nodes)
        let.start.push_back({node.position.x, node.position.y, node.position.z});
    change(bare);
    const auto body = bullet::soft_body_of(bare);
    if (!body) return let;
    Simulation simulation(scene, test::on(Backend::reference));
    simulation.advance(time);
    const auto x = simulation.positions();
    let.ours.assign(x.begin(), x.end());
    let.bullets = after_steps(*body, let.start.size(), 400, 1e-3f);
    return let;
}

/// The largest strain of its structural and shear springs. (Skip springs across a fold do not count.)
double stretch_of(const std::vector<Vec3>& x, const std::vector<serial::Spring>& springs)
{
    test::Largest stretch;
    for (const serial::Spring& s : springs)
        stretch.add(test::distance(x.at(s.i), x.at(s.j)) / double{s.rest_length} - 1);
    return stretch.value();
}

TEST(BulletSoftBody, HangsAndSwingsAsOurClothDoes)
{
    // Its links are as stiff as one projection per step makes them, ours have 1,000 N/m: both stretch by some
    // per mille. Bullet's skip springs are links, and projection damps, so its motion differs by an eighth of
    // the fall of the free edge.
    const Let whole = let_go([](serial::Cloth&) {});
    if (whole.bullets.empty()) GTEST_SKIP() << "built without Bullet";
    const double moved = test::largest_difference(whole.ours, whole.start);
    const double apart = test::largest_difference(whole.bullets, whole.ours);
    const double stretch = stretch_of(whole.bullets, whole.springs);
    std::printf("moved by %.3g m; %.3g m apart; stretch %.3g, ours %.3g\n", moved, apart, stretch,
                stretch_of(whole.ours, whole.springs));
    EXPECT_GT(moved, 0.5);
    EXPECT_LT(apart, 0.2 * moved);
    EXPECT_LT(stretch, 0.01);
}

TEST(BulletSoftBody, ThatDoesNotHoldTogetherIsSeen)
{
    const Let none = let_go([](serial::Cloth& cloth) { cloth.springs.clear(); });
    if (none.bullets.empty()) GTEST_SKIP() << "built without Bullet";
    EXPECT_GT(stretch_of(none.bullets, none.springs), 0.1);
    const Let cut = let_go([](serial::Cloth& cloth) {  // between the third row and the fourth
        std::erase_if(cloth.springs, [](const serial::Spring& s) { return s.i < 27 && s.j >= 27; });
    });
    EXPECT_GT(stretch_of(cut.bullets, cut.springs), 0.1);
}

TEST(SerialCloth, RefusesWhatItDoesNotKnow)
{
    Scene scene = hung_sheet(5, 5);
    scene.air.density = 1.2;
    EXPECT_ERROR(serial::cloth_of(scene), bad_input, "moving air");
    scene.air.density = 0;
    scene.add(Box{});
    EXPECT_ERROR(serial::cloth_of(scene), bad_input, "a box or a capsule");
    EXPECT_ERROR(serial::body_of(scene), bad_input, "the method mass_spring");
}

}  // namespace
}  // namespace pliant
