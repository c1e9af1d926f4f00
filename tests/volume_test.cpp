// Soft bodies against what is known of them: the gradient against finite differences, what must not change,
// and what is asked of them. The bars of the volume that is kept are in volume_bars_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>

#include "solve/frame.hpp"
#include "solve/mass_spring.hpp"
#include "test_bodies.hpp"
#include "test_differences.hpp"
#include "test_errors.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

namespace fs = std::filesystem;
using test::ball;
using test::free_scene;
using test::volume_bar;

/// 6 V about the first vertex, in double.
double sixfold(const std::vector<Vec3d>& x, std::span<const Triangle> triangles)
{
    double sum = 0;
    for (const Triangle& t : triangles) sum += dot(x[t[0]] - x[0], cross(x[t[1]] - x[0], x[t[2]] - x[0]));
    return sum;
}

std::vector<Vec3d> doubles(std::span<const Vec3> values)
{
    std::vector<Vec3d> result;
    for (const Vec3& a : values) result.push_back(to_double(a));
    return result;
}

/// A model whose nodes are displaced and moving, at random but the same in every run.
ClothModel shaken(const Scene& scene, float shake, float speed)
{
    ClothModel model(scene.cloth(0), scene);
    std::mt19937 engine(3);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (Vec3& x : model.shape.positions)
        x = {x.x + shake * unit(engine), x.y + shake * unit(engine), x.z + shake * unit(engine)};
    for (Vec3& v : model.shape.velocities)
        v = {speed * unit(engine), speed * unit(engine), speed * unit(engine)};
    return model;
}

struct Momenta {
    Vec3d linear, angular;
    double scale = 0;  ///< sum of m |v|
};
Momenta momenta_of(PassRunner& runner, const ClothModel& model, std::uint32_t parity)
{
    std::vector<float> x, v;
    runner.read(0, Resource::position, parity, x);
    runner.read(0, Resource::velocity, parity, v);
    Momenta sum;
    for (std::size_t i = 0; i < model.node_count(); ++i) {
        const double m = model.masses.kg[i];
        const Vec3d p = {double{x[3 * i]}, double{x[3 * i + 1]}, double{x[3 * i + 2]}};
        const Vec3d u = Vec3d{double{v[3 * i]}, double{v[3 * i + 1]}, double{v[3 * i + 2]}} * m;
        sum.linear = sum.linear + u;
        sum.angular = sum.angular + cross(p, u);
        sum.scale += std::sqrt(dot(u, u));
    }
    return sum;
}
double size_of(Vec3d a) { return std::sqrt(dot(a, a)); }

std::uint32_t run_steps(PassRunner& runner, const ClothModel& model, std::uint32_t steps, double dt)
{
    Program program{steps, {}, 0};
    program.parity_after = append_frame({&model, 1}, steps, 0, program.calls);
    runner.run(program, {dt, 0, {}, true});
    return program.parity_after;
}

MeasureTotals measures_of(PassRunner& runner, const ClothModel& model)
{
    Program program{1, {}, 0};
    append_measures(model, 0, 0, 0, program.calls);
    runner.run(program, {0, 0, {}, true});
    return runner.measures(0);
}

// --- the gradient
// ---------------------------------------------------------------------------------------------------------

TEST(VolumeGradient, MatchesFiniteDifferencesAndPushesAndTurnsNothing)
{
    for (SurfaceMesh mesh : {icosphere_mesh({.radius = 0.5, .frequency = 4}), blob_mesh({.vertices = 1000}),
                             torus_mesh({.major_segments = 20, .minor_segments = 9})}) {
        const Scene scene = free_scene(Cloth::soft_body(std::move(mesh)));
        const ClothModel model = shaken(scene, 0.01f, 0);
        const auto runner = test::make_runner(Backend::reference, model);
        runner->run({1, {{Pass::volume_gather, 0, 0, 0}}, 0}, {1e-4, 0, {}, true});
        std::vector<float> g;
        runner->read(0, Resource::gradient, 0, g);

        std::vector<Vec3d> x = doubles(model.shape.positions);
        // 6 V is linear in each coordinate, so that a difference over 0.1 m is exact but for rounding of
        // 1e-16 of 6 V.
        constexpr double h = 0.05;
        test::Largest most;
        for (const float a : g) most.add(std::abs(double{a}));
        const double largest = most.value();
        Vec3d sum{}, turn{};
        for (std::size_t i = 0; i < x.size(); ++i) {
            double* const coordinates[] = {&x[i].x, &x[i].y, &x[i].z};
            for (std::size_t k = 0; k < 3; ++k) {
                const double before = *coordinates[k];
                *coordinates[k] = before + h;
                const double above = sixfold(x, model.shape.triangles());
                *coordinates[k] = before - h;
                const double below = sixfold(x, model.shape.triangles());
                *coordinates[k] = before;
                EXPECT_NEAR(double{g[3 * i + k]}, (above - below) / (2 * h), 1e-6 * largest) << "node " << i;
            }
            const Vec3d gradient{double{g[3 * i]}, double{g[3 * i + 1]}, double{g[3 * i + 2]}};
            sum = sum + gradient;
            turn = turn + cross(x[i], gradient);
        }
        // Read back as floats: each number is off by 2^-25 of itself at most.
        const double tolerance = 0x1p-24 * largest * static_cast<double>(x.size());
        EXPECT_LE(size_of(sum), tolerance);
        EXPECT_LE(size_of(turn), tolerance);
    }
}

TEST(VolumeGradient, AsPrintedIsNeitherAGradientNorFreeOfThrust)
{
    // Eq. (10) of the paper: every entry is -3 times the right one, but dV/dz2 is +3 times.
    const SurfaceMesh mesh = blob_mesh({.vertices = 1000});  // has no symmetry that would hide the thrust
    std::vector<Vec3d> printed(mesh.vertices.size()), right(mesh.vertices.size());
    const std::vector<Vec3d> x = doubles(mesh.vertices);
    for (const Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3d entry = cross(x[t[(k + 1) % 3]], x[t[(k + 2) % 3]]) * (1.0 / 6);
            right[t[k]] = right[t[k]] + entry;
            printed[t[k]] = printed[t[k]] + Vec3d{-3 * entry.x, -3 * entry.y, (k == 1 ? 3 : -3) * entry.z};
        }
    Vec3d sum{}, sum_printed{};
    double along = 0, along_printed = 0;  // of a body that grows, 3 V
    for (std::size_t i = 0; i < x.size(); ++i) {
        sum = sum + right[i];
        sum_printed = sum_printed + printed[i];
        along += dot(right[i], x[i]);
        along_printed += dot(printed[i], x[i]);
    }
    const double volume = sixfold(x, mesh.triangles) / 6;
    EXPECT_NEAR(along, 3 * volume, 1e-12);
    EXPECT_LE(size_of(sum), 1e-12);
    EXPECT_LT(along_printed, -volume);      // it points inward
    EXPECT_GT(size_of(sum_printed), 1e-3);  // m2: it pushes the body as a whole
}

TEST(Volume, DoesNotChangeWhenABodyIsMovedAndTurned)
{
    const SurfaceMesh mesh = blob_mesh({.vertices = 1500});
    double first = 0;
    for (const Vec3d place : {Vec3d{0, 0, 0}, Vec3d{100, -30, 7}, Vec3d{1000, 1000, 1000}}) {
        Cloth body = Cloth::soft_body(mesh);
        body.position = place;
        body.rotation = place * 0.7;
        Simulation simulation(free_scene(body), test::on(Backend::cpu));
        const double volume = simulation.report().bodies.at(0).volume;
        if (first == 0) first = volume;
        // Vertices are rounded to floats near the body's own origin: 2^-24 of 1 m each, and they average out.
        EXPECT_NEAR(volume / first, 1, 1e-6);
    }
}

// --- what the constraint must not change
// --------------------------------------------------------------------------------------

TEST(VolumeMomentum, AFreeBodyKeepsItsMomenta)
{
    constexpr std::uint32_t steps = 400;
    for (const bool weighted : {false, true})
        for (const Backend backend : {Backend::reference, Backend::cpu}) {
            BodyOptions options;
            if (weighted) options.volume.focus = VolumeFocus{{0, 0.5, 0}, 0.8};
            const Scene scene = free_scene(ball(6, options));
            const ClothModel model = shaken(scene, 0.01f, 1);
            const auto runner = test::make_runner(backend, model);
            const Momenta before = momenta_of(*runner, model, 0);
            const MeasureTotals at_first = measures_of(*runner, model);
            const Momenta after = momenta_of(*runner, model, run_steps(*runner, model, steps, 1e-4));
            // Nodes have given each other what each had on its own: springs are damped.
            EXPECT_LT(runner->measures(0).kinetic_energy, 0.9 * at_first.kinetic_energy);
            // A step rounds a velocity by 2^-24 of it, and the correction by that of the positions over dt;
            // roundings are independent of each other, so that they grow with the root of their number. In
            // double only reading back rounds, by 2^-24 of each number, once.
            const double rounding = backend == Backend::reference ? 4 * 0x1p-24 : 64 * 0x1p-24;
            EXPECT_LE(size_of(after.linear - before.linear) / before.scale, rounding)
                << name_of(backend) << weighted;
            if (!weighted) {  // weights take the thrust off, and not the torque
                EXPECT_LE(size_of(after.angular - before.angular) / before.scale, rounding)
                    << name_of(backend);
            }
        }
}

TEST(VolumeEnergy, IsNotPumpedIntoAFreeBody)
{
    // Without damping, oscillating for 4,000 steps: kinetic and elastic energy stay what they were to the
    // order of the integrator, whose energy error is of the order omega dt = 0.02.
    Cloth body = ball(6);
    body.springs.structural = {5000, 0};
    const Scene scene = free_scene(body);
    for (const Backend backend : {Backend::reference, Backend::cpu}) {
        const ClothModel model = shaken(scene, 0.005f, 0.3f);
        const auto runner = test::make_runner(backend, model);
        run_steps(*runner, model, 2, 1e-4);  // the first step takes away the velocity along the gradient
        const MeasureTotals before = runner->measures(0);
        test::Largest most;
        test::Smallest least;
        for (int frame = 0; frame < 20; ++frame) {
            run_steps(*runner, model, 200, 1e-4);
            const MeasureTotals now = runner->measures(0);
            most.add(now.kinetic_energy + now.elastic_energy);
            least.add(now.kinetic_energy + now.elastic_energy);
        }
        const double energy = before.kinetic_energy + before.elastic_energy;
        EXPECT_LE(most.value(), 1.03 * energy) << name_of(backend);
        EXPECT_GE(least.value(), 0.97 * energy) << name_of(backend);
        // It oscillates: what moves and what is stretched take turns.
        EXPECT_GT(std::abs(runner->measures(0).elastic_energy - before.elastic_energy), 0.01 * energy);
    }
}

TEST(VolumePlace, AKilometreAwayABodyBehavesAsAtTheOrigin)
{
    std::vector<Vec3> velocities[2];
    for (const bool far : {false, true}) {
        Cloth body = ball(6);
        body.position = {far ? 1000.0 : 0.0, 0.51, far ? -1000.0 : 0.0};
        Scene scene = free_scene(body);
        scene.gravity = {0, -9.81, 0};
        scene.add(Plane{});
        scene.add(Sphere{.centre = {far ? 1000.4 : 0.4, 0.1, far ? -1000.0 : 0.0}, .radius = 0.25});
        Simulation simulation(scene, test::on(Backend::cpu));
        for (int frame = 0; frame < 100; ++frame) simulation.advance(1e-3);
        const auto v = simulation.velocities();
        velocities[far].assign(v.begin(), v.end());
        EXPECT_LE(simulation.report().volume.error_max, 1e-6);
    }
    // The same coordinates against the body's own origin, but for the sphere's, which 1000.4 - 1000 rounds in
    // double.
    const double fastest = test::largest_difference(velocities[0], std::vector<Vec3>(velocities[0].size()));
    EXPECT_GT(fastest, 0.1);
    EXPECT_LE(test::largest_difference(velocities[0], velocities[1]), 1e-3 * fastest);
}

// --- what is asked for
// ------------------------------------------------------------------------------------------------------

TEST(VolumeTarget, IsFollowedOverTime)
{
    BodyOptions options;
    options.volume.target = {{0, 1}, {0.02, 1.3}};
    const Scene scene = free_scene(ball(5, options));
    for (const Backend backend : {Backend::reference, Backend::cpu, Backend::vulkan}) {
        Simulation simulation(scene, test::on(backend));
        for (int frame = 0; frame < 10; ++frame) simulation.advance(1e-3);
        EXPECT_NEAR(simulation.report().bodies.at(0).ratio, 1.15, 1e-5) << name_of(backend);
        EXPECT_LE(simulation.report().volume.error_max, 1e-5) << name_of(backend);
    }
}

TEST(VolumeTarget, ThatBeginsElsewhereIsGoneToFromRest)
{
    using Values = std::vector<std::pair<double, double>>;
    const auto taken = [](const std::vector<TimedValue>& target) {
        Values values;
        for (const TimedValue& value : gradual_target(target)) values.emplace_back(value.time, value.value);
        return values;
    };
    EXPECT_EQ(fastest_start, 2);
    EXPECT_EQ(taken({}), Values{});
    EXPECT_EQ(taken({{0, 1}, {0.01, 3}}),
              (Values{{0, 1}, {0.01, 3}}));  // what is asked for by keyframes stays
    EXPECT_EQ(taken({{0, 3}}), (Values{{0, 1}, {1, 3}}));
    EXPECT_EQ(taken({{0.5, 2}}), (Values{{0, 1}, {0.5, 2}}));
    EXPECT_EQ(taken({{0, 0.5}, {1, 0.5}, {2, 1}}), (Values{{0, 1}, {0.25, 0.5}, {1, 0.5}, {2, 1}}));
    // It meets a ramp of 1 a second from 2 on at 1 + 2 t = 2 + t.
    EXPECT_EQ(taken({{0, 2}, {3, 5}}), (Values{{0, 1}, {1, 3}, {3, 5}}));
    // One of 4 a second it does not meet before that ends, at 1 s with 6; 5 later, by 2 a second, at 2.5 s.
    EXPECT_EQ(taken({{0, 2}, {1, 6}}), (Values{{0, 1}, {1, 3}, {2.5, 6}}));
}

TEST(VolumeTarget, ThatBeginsElsewhereDoesNotThrowTheBody)
{
    for (const double value : {0.2, 3.0}) {
        BodyOptions options;
        options.volume.target = {{0, value}};
        Cloth body = ball(5, options);
        body.position = {0, 2, 0};
        Scene scene;
        scene.method = Method::volume;
        scene.add(body);
        scene.add(Plane{});
        Simulation simulation(scene, test::on(Backend::cpu));
        EXPECT_EQ(simulation.warnings().size(), 1u);
        for (int frame = 0; frame < 75; ++frame) {
            simulation.advance(1 / 60.0);
            double highest = 0;
            for (const Vec3& x : simulation.positions()) highest = std::max(highest, double{x.y});
            EXPECT_LT(highest, 2 + 0.5 * std::cbrt(value) + 0.3)
                << value;  // m: no higher than it began, but for its size
        }
        EXPECT_NEAR(simulation.report().bodies.at(0).ratio, value, 1e-3);
        EXPECT_LE(simulation.report().volume.error_max, 1e-3);
    }
}

TEST(VolumeTarget, ThatChangesFastIsWarnedOf)
{
    BodyOptions options;
    options.volume.target = {{0, 1}, {1, 2.9}};
    EXPECT_TRUE(Simulation(free_scene(ball(3, options)), test::on(Backend::cpu)).warnings().empty());
    options.volume.target = {{0, 1}, {1, 1}, {1.1, 2.9}};
    const auto warnings = Simulation(free_scene(ball(3, options)), test::on(Backend::cpu)).warnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("changes by 19 a second from 1 s on"), std::string::npos) << warnings[0];
}

TEST(VolumePressure, PushesEveryNodeOutwardByItsShareOfTheArea)
{
    BodyOptions options;
    options.volume.pressure = {{0, 100}};
    Cloth body = ball(8, options);
    body.springs.structural = {0, 0};
    Scene scene = free_scene(body);
    scene.method = Method::mass_spring;
    scene.time.substeps = 1;
    Simulation simulation(scene, test::on(Backend::cpu));
    const std::vector<Vec3> x(simulation.positions().begin(), simulation.positions().end());
    simulation.advance(1e-3);
    // 100 Pa on the 3.14 m2 of a sphere (its mesh: 1.1 % less), on 642 nodes of 1 kg, for 1 ms: in sum 0.3108
    // N s outward.
    double outward = 0;
    Vec3d sum{};
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Vec3d v = to_double(simulation.velocities()[i]), p = to_double(x[i]);
        outward += dot(v, p) / size_of(p);
        sum = sum + v;
    }
    double area = 0;
    for (const Triangle& t : simulation.triangles()) {
        const Vec3d a = to_double(x[t[0]]);
        area += 0.5 * size_of(cross(to_double(x[t[1]]) - a, to_double(x[t[2]]) - a));
    }
    EXPECT_NEAR(outward, 100 * area * 1e-3,
                0.01 * outward);  // nodes' normals lean from the radius by a few degrees
    EXPECT_LE(size_of(sum), 1e-6);
}

TEST(VolumeForces, ATorqueTurnsItsRegionAlone)
{
    BodyOptions options;
    options.forces = {{{{-1, 0.2, -1}, {1, 1, 1}}, {0, 0, 3}, {0, 2, 0}}};
    Cloth body = ball(6, options);
    body.springs.structural = {0, 0};
    Scene scene = free_scene(body);
    scene.method = Method::mass_spring;
    scene.time.substeps = 1;
    for (const Backend backend : {Backend::reference, Backend::cpu, Backend::vulkan}) {
        Simulation simulation(scene, test::on(backend));
        const std::vector<Vec3> x(simulation.positions().begin(), simulation.positions().end());
        simulation.advance(1e-3);
        Vec3d force{}, torque{};
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Vec3d v = to_double(simulation.velocities()[i]) * 1e3;  // of 1 kg, over dt
            force = force + v;
            torque = torque + cross(to_double(x[i]), v);
            if (x[i].y < 0.19f) {
                EXPECT_EQ(size_of(v), 0);
            }
        }
        EXPECT_NEAR(force.z, 3, 1e-4);
        EXPECT_NEAR(force.x, 0, 1e-4);
        EXPECT_NEAR(torque.y, 2, 1e-4);
    }
}

TEST(VolumeContact, TheCorrectionDoesNotPushNodesIntoThePlate)
{
    Scene scene = read_scene("press", {"bodies[0].blob.vertices=1000"});
    Simulation simulation(scene, test::on(Backend::cpu));
    test::Largest deepest;
    for (int frame = 0; frame < 200; ++frame) {
        simulation.advance(1 / scene.time.frame_rate);
        deepest.add(simulation.report().measures.max_penetration);
    }
    // A node that comes near in a step and is moved by that step's correction may enter by that much: 10 um
    // at 1e-4 s.
    EXPECT_LE(deepest.value(), 1e-4);
    EXPECT_GT(deepest.value(), 0);  // they touch
    EXPECT_LE(simulation.report().volume.error_max, volume_bar);
}

TEST(VolumeBodies, AreGivenInTheOrderOfTheirMeshes)
{
    const SurfaceMesh mesh = icosphere_mesh({.radius = 0.5, .frequency = 5});
    Scene scene = free_scene(Cloth::soft_body(mesh));
    scene.add(Cloth::sheet({.rows = 3, .columns = 3}));
    Simulation simulation(scene, test::on(Backend::cpu));
    ASSERT_EQ(simulation.positions(0).size(), mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        EXPECT_LE(size_of(to_double(simulation.positions(0)[i]) - to_double(mesh.vertices[i])), 1e-7);
    ASSERT_EQ(simulation.triangles(0).size(), mesh.triangles.size());
    EXPECT_EQ(simulation.triangles(0)[7], mesh.triangles[7]);
    EXPECT_EQ(simulation.positions(1).size(), 9u);
    EXPECT_EQ(simulation.body_count(), 1u);
}

TEST(VolumeWeights, ComeFromAPropertyOfTheVertices)
{
    const fs::path folder = fs::path(testing::TempDir()) / "pliant_volume_weights";
    fs::create_directory(folder);
    const SurfaceMesh mesh = icosphere_mesh({.radius = 0.5, .frequency = 3});
    std::ofstream ply(folder / "ball.ply");
    ply << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.size()
        << "\nproperty float x\nproperty float y\nproperty float z\nproperty float give\nelement face "
        << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Vec3& v : mesh.vertices)
        ply << v.x << ' ' << v.y << ' ' << v.z << ' ' << (v.y > 0 ? 1 : 0) << '\n';
    for (const Triangle& t : mesh.triangles) ply << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    ply.close();
    std::ofstream(folder / "scene.json") << R"({"pliant": 1, "method": "volume", "gravity": [0, 0, 0],
        "time": {"dt": 1e-3, "substeps": 1},
        "bodies": [{"mesh": {"file": "ball.ply", "weights": "give"}, "node_mass": 1, "damping": 0,
                    "springs": {"stiffness": 0, "damping": 0}, "volume": {"target": [{"time": 0, "value": 1}, {"time": 1e-3, "value": 1.1}]}}]})";
    const Scene scene = read_scene((folder / "scene.json").string());
    Simulation simulation(scene, test::on(Backend::cpu));
    simulation.advance(1e-3);
    EXPECT_NEAR(simulation.report().bodies.at(0).ratio, 1.1, 1e-5);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const double speed = size_of(to_double(simulation.velocities()[i]));
        if (mesh.vertices[i].y > 0)
            EXPECT_GT(speed, 0) << i;
        else
            EXPECT_EQ(speed, 0) << i;
    }
    EXPECT_ERROR(read_scene((folder / "scene.json").string(), {"bodies[0].mesh.weights=take"}), bad_input,
                 "take");
    fs::remove_all(folder);
}

TEST(VolumeBodies, ManyOfOneMaterialAreSteppedTogetherAsEachWouldBeAlone)
{
    // Bit by bit where they share the first one's origin; here each is a metre from it, so that rounding
    // differs.
    Scene together = free_scene(ball(4));
    together.gravity = {0, -9.81, 0};
    together.add(Plane{});
    together.cloth_handle(0)->position = {0, 0.51, 0};
    Cloth second = ball(5), third = ball(3);
    second.position = {2, 0.53, 0};
    second.velocity = {0, -1, 0};
    third.position = {0, 0.6, 3};
    third.springs.structural.stiffness = 4000;  // another material
    together.add(second);
    together.add(third);
    Simulation all(together, test::on(Backend::cpu));
    for (int frame = 0; frame < 60; ++frame) all.advance(1e-3);
    ASSERT_EQ(all.report().bodies.size(), 3u);
    EXPECT_LE(all.report().volume.error_max, volume_bar);
    for (std::size_t c = 0; c < 3; ++c) {
        Scene alone = free_scene(together.cloth(c));
        alone.gravity = {0, -9.81, 0};
        alone.add(Plane{});
        Simulation one(alone, test::on(Backend::cpu));
        for (int frame = 0; frame < 60; ++frame) one.advance(1e-3);
        ASSERT_EQ(all.positions(c).size(), one.positions().size());
        for (std::size_t i = 0; i < one.positions().size(); ++i)
            EXPECT_LE(size_of(to_double(all.positions(c)[i]) - to_double(one.positions()[i])), 2e-5)
                << c << ' ' << i;
    }
    std::uint64_t hashes[2];
    for (const bool vulkan : {false, true}) {
        Simulation simulation(together, test::on(vulkan ? Backend::vulkan : Backend::cpu));
        for (int frame = 0; frame < 5; ++frame) simulation.advance(1e-3);
        EXPECT_TRUE(simulation.report().finite);
        hashes[vulkan] = simulation.state_hash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(VolumeBodies, AnOpenMeshIsRefused)
{
    SurfaceMesh open = icosphere_mesh({.radius = 0.5, .frequency = 3});
    open.triangles.pop_back();
    EXPECT_ERROR(Simulation simulation(free_scene(Cloth::soft_body(open))), bad_input,
                 "cannot be a body with volume");
    SurfaceMesh inward = icosphere_mesh({.radius = 0.5, .frequency = 3});
    for (Triangle& t : inward.triangles) std::swap(t[0], t[1]);
    EXPECT_ERROR(Simulation simulation(free_scene(Cloth::soft_body(inward))), bad_input, "body with volume");
}

TEST(VolumeBodies, WarnsOfEdgesThatSinglePrecisionCannotResolve)
{
    // 0.5 m from the middle positions are rounded by 3e-8 m, a thousandth of 3e-5 m; far away as well as
    // here.
    for (const double thickness : {1e-3, 1e-5}) {
        Cloth body =
            Cloth::soft_body(box_mesh({.size = {1, 1, thickness}, .faces = 2}), {}, {.node_mass = 1});
        body.position = {1000, 0, 0};
        const std::string warning = Simulation(free_scene(body), test::on(Backend::cpu)).resolution_warning();
        if (thickness < 3e-5)
            EXPECT_NE(warning.find("m from its middle"), std::string::npos) << warning;
        else
            EXPECT_EQ(warning, "");
    }
}

TEST(VolumeBodies, WhatDoesNotFitIsRefused)
{
    const auto refusal = [](const std::function<void(Scene&, Cloth&)>& change) {
        return std::string(test::error_of([&] {
                               Cloth body = ball(3);
                               Scene scene = free_scene(Cloth::sheet({.rows = 3, .columns = 3}));
                               change(scene, body);
                               scene.add(body);
                               validate(scene);
                           }).what());
    };
    EXPECT_NE(refusal([](Scene& s, Cloth&) { s.method = Method::constraint; }).find("bodies[0].springs"),
              std::string::npos);
    EXPECT_NE(refusal([](Scene&, Cloth& b) {
                  b.body->volume.target = {{0, 0}};
              }).find("target[0].value"),
              std::string::npos);
    EXPECT_NE(refusal([](Scene&, Cloth& b) {
                  b.body->volume.pressure = {{1, 0}, {1, 5}};
              }).find("later"),
              std::string::npos);
    EXPECT_NE(refusal([](Scene&, Cloth& b) {
                  b.body->volume.weights = {1, 2};
              }).find("weight"),
              std::string::npos);
    EXPECT_NE(refusal([](Scene&, Cloth& b) { b.formulation = Formulation::spring_list; }).find("formulation"),
              std::string::npos);
    EXPECT_NE(refusal([](Scene&, Cloth& b) { b.body->internal.neighbours = 0; }).find("neighbours"),
              std::string::npos);
}

}  // namespace
}  // namespace pliant
