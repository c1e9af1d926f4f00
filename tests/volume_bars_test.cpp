// How well soft bodies keep their volume: falling, pressed, twisted, in long steps, and the same bits on
// every backend.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "test_bodies.hpp"
#include "test_differences.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

using test::ball;
using test::free_scene;
using test::volume_bar;

/// A body that comes down on a plane at 2 m/s from 1 cm above it, one step in a frame: after 50 of 400 frames
/// it hits.
Scene impact(Cloth body, double dt = 1e-4)
{
    const Scene probe = free_scene(body);
    const ClothModel model(probe.cloth(0), probe);
    test::Smallest lowest;
    for (const Vec3& x : model.shape.positions) lowest.add(double{x.y} + model.shape.origin.y);
    body.position.y += 0.012 - lowest.value();
    body.velocity = {0, -2, 0};
    Scene scene = free_scene(body);
    scene.gravity = {0, -9.81, 0};
    scene.time = {.duration = 1, .frame_rate = 1 / dt, .substeps = 1};
    scene.add(Plane{});
    return scene;
}

VolumeReport fall(const Scene& scene, Backend backend, int frames)
{
    Simulation simulation(scene, test::on(backend));
    for (int frame = 0; frame < frames; ++frame) simulation.advance(1 / scene.time.frame_rate);
    EXPECT_TRUE(simulation.report().finite);
    EXPECT_EQ(simulation.report().validation_messages, 0u);
    test::Smallest lowest;
    for (const Vec3& x : simulation.positions()) lowest.add(double{x.y});
    EXPECT_LT(lowest.value(), 0.0025) << "it never came down";
    return simulation.report().volume;
}

std::string text_of(double error)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.2e", error);
    return text;
}

TEST(VolumeBar, FreeFallOfSphereAndTorus)
{
    Cloth torus =
        Cloth::soft_body(torus_mesh({.major_segments = 36, .minor_segments = 18}), {}, {.node_mass = 1});
    torus.springs.structural = {5000, 200};
    for (const Cloth& body : {ball(16), torus}) {
        EXPECT_LE(fall(impact(body), Backend::cpu, 400).error_max, volume_bar);
        EXPECT_LE(fall(impact(body), Backend::vulkan, 100).error_max, volume_bar);
    }
}

/// The figure of `blob` with about so many nodes, of even triangles or as scanned.
SurfaceMesh figure_of(std::uint32_t vertices, bool scanned)
{
    const SurfaceMesh mesh = blob_mesh({.vertices = vertices});
    return scanned ? test::as_scanned(mesh) : mesh;
}

TEST(VolumeBar, FreeFallOfFigures)
{
    const std::pair<std::uint32_t, bool> figures[] = {{2'500, false}, {3'000, true},   {8'000, false},
                                                      {15'000, true}, {31'000, false}, {35'000, true}};
    for (const auto& [vertices, scanned] : figures) {
        Cloth body = Cloth::soft_body(figure_of(vertices, scanned), {}, {.node_mass = 1});
        body.springs.structural = {5000, 200};
        const VolumeReport report = fall(impact(body), Backend::cpu, 400);
        EXPECT_LE(report.error_max, volume_bar) << vertices;
        RecordProperty("figure_" + std::to_string(vertices), text_of(report.error_max));
    }
}

TEST(VolumeBits, OfAScannedFigureAreTheSameOnCpuAndVulkan)
{
    Cloth body = Cloth::soft_body(figure_of(2'500, true), {}, {.node_mass = 1});
    body.springs.structural = {5000, 200};
    const Scene scene = impact(body);
    std::uint64_t hashes[2];
    for (const bool vulkan : {false, true}) {
        Simulation simulation(scene, test::on(vulkan ? Backend::vulkan : Backend::cpu));
        for (int frame = 0; frame < 80; ++frame) simulation.advance(1e-4);  // it hits after 50
        EXPECT_LE(simulation.report().volume.error_max, volume_bar);
        hashes[vulkan] = simulation.state_hash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

/// The scene `press` with another figure between its plates, as high as its own and at its place.
Scene pressed(const SurfaceMesh& mesh)
{
    Scene scene = read_scene("press");
    Cloth& figure = *scene.cloth_handle(0);
    Vec3 least = mesh.vertices.front(), most = least;
    for (const Vec3& v : mesh.vertices) {
        least = {std::min(least.x, v.x), std::min(least.y, v.y), std::min(least.z, v.z)};
        most = {std::max(most.x, v.x), std::max(most.y, v.y), std::max(most.z, v.z)};
    }
    figure.shape = mesh;
    figure.scale = 0.75 / double{most.y - least.y};
    const Vec3d middle = (to_double(least) + to_double(most)) * 0.5;
    figure.position = Vec3d{0, 0.38, 0} - middle * figure.scale;
    return scene;
}

TEST(VolumeBar, PressOfFigures)
{
    for (const std::uint32_t vertices : {2'500u, 15'000u}) {
        const Scene scene = pressed(figure_of(vertices, true));
        Simulation simulation(scene, test::on(Backend::cpu));
        test::Largest highest;
        for (int frame = 0; frame < 600; ++frame) simulation.advance(1 / scene.time.frame_rate);
        for (const Vec3& x : simulation.positions()) highest.add(double{x.y});
        EXPECT_TRUE(simulation.report().finite) << vertices;
        EXPECT_LT(highest.value(), 0.425) << vertices << " is not between the plates";
        EXPECT_LE(simulation.report().volume.error_max, volume_bar) << vertices;
        RecordProperty("figure_" + std::to_string(vertices), text_of(simulation.report().volume.error_max));
    }
}

TEST(VolumeBar, PressedSpringsAloneCollapse)
{
    const Scene scene = read_scene("press", {"method=mass_spring"});
    Simulation simulation(scene, test::on(Backend::cpu));
    for (int frame = 0; frame < 600; ++frame) simulation.advance(1 / scene.time.frame_rate);
    EXPECT_TRUE(simulation.report().finite);
    EXPECT_GT(simulation.report().volume.loss_max, 0.3);
}

TEST(VolumeBar, SpringsAloneCollapse)
{
    Scene scene = read_scene("free_fall", {"method=mass_spring"});
    Simulation simulation(scene, test::on(Backend::cpu));
    for (int frame = 0; frame < 400; ++frame) simulation.advance(1 / scene.time.frame_rate);
    EXPECT_GT(simulation.report().volume.loss_max, 0.5);
}

TEST(VolumeBar, TwistedCubeWithAndWithoutTheConstraint)
{
    for (const char* method : {"method=volume", "method=mass_spring"}) {
        const Scene scene = read_scene("twist", {method});
        Simulation simulation(scene, test::on(Backend::cpu));
        EXPECT_EQ(simulation.spring_count(), 1777u);
        EXPECT_EQ(simulation.node_count(), 386u);
        for (int frame = 0; frame < 200; ++frame) simulation.advance(1 / scene.time.frame_rate);
        if (scene.method == Method::volume)
            EXPECT_LE(simulation.report().volume.error_max, 1e-5);
        else
            EXPECT_GT(simulation.report().volume.error_max, 0.05);
    }
}

TEST(VolumeBar, LongSteps)
{
    // 1e-3 s, and a sixtieth in 16, with what explicit springs stand there.
    for (const double dt : {1e-3, 1.0 / 960}) {
        Cloth body = ball(12);
        body.springs.structural = {5000, 50};
        const Scene scene = impact(body, dt);
        Simulation simulation(scene, test::on(Backend::cpu));
        EXPECT_GT(simulation.stable_step(), dt);
        EXPECT_LE(fall(scene, Backend::cpu, 400).error_max, volume_bar) << dt;
    }
}

TEST(VolumeBits, AreTheSameOnCpuAndVulkan)
{
    const Scene scene = impact(ball(5));
    std::uint64_t hashes[2];
    for (const bool vulkan : {false, true}) {
        Simulation simulation(scene, test::on(vulkan ? Backend::vulkan : Backend::cpu));
        for (int frame = 0; frame < 80; ++frame) simulation.advance(1e-4);
        EXPECT_LE(simulation.report().volume.error_max, volume_bar);
        hashes[vulkan] = simulation.state_hash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace pliant
