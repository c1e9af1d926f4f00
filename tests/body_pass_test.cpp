// The passes of soft bodies on every backend, with odd sizes: cpu (each instruction set of this machine, 1,
// 2, 3 and 7 threads) and vulkan must agree bit by bit, and both must match the double-precision reference up
// to rounding.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "pliant/mesh_generators.hpp"
#include "solve/frame.hpp"
#include "test_bits.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

constexpr double dt = 1e-4;

struct BodyCase {
    const char* name;
    SurfaceMesh (*mesh)();
    bool rich;  ///< air, forces, pressure, weights, internal springs, pins
    bool constrained = true, list = false;
};
void PrintTo(const BodyCase& c, std::ostream* out) { *out << c.name; }

// Numbers of nodes around packs, slices of 16 and blocks of 256, and of more than 256 blocks.
const BodyCase cases[] = {
    {"tetrahedron_4",
     [] {
         return SurfaceMesh{
             {{0.4f, 0.4f, 0.4f}, {-0.4f, -0.4f, 0.4f}, {-0.4f, 0.4f, -0.4f}, {0.4f, -0.4f, -0.4f}},
             {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
     },
     false},
    {"icosahedron_12", [] { return icosphere_mesh({.radius = 0.4, .frequency = 1}); }, false},
    {"box_8",
     [] {
         return box_mesh({.size = {0.8, 0.6, 0.7}, .faces = 1});
     },
     false},
    {"box_26_rich",
     [] {
         return box_mesh({.size = {0.8, 0.6, 0.7}, .faces = 2});
     },
     true},
    {"sphere_42", [] { return icosphere_mesh({.radius = 0.4, .frequency = 2}); }, false},
    {"sphere_252_rich", [] { return icosphere_mesh({.radius = 0.4, .frequency = 5}); }, true},
    {"torus_289", [] { return torus_mesh({.major_segments = 17, .minor_segments = 17}); }, false},
    {"capsule_rich", [] { return capsule_mesh({.cap_rings = 5, .bands = 7, .segments = 31}); }, true},
    {"blob_1000", [] { return blob_mesh({.vertices = 1000}); }, true},
    {"uv_sphere_70000", [] { return uv_sphere_mesh({.radius = 0.5, .rings = 200, .segments = 352}); }, false},
    {"springs_alone", [] { return icosphere_mesh({.radius = 0.4, .frequency = 5}); }, false, false},
    {"springs_alone_rich", [] { return torus_mesh({.major_segments = 17, .minor_segments = 17}); }, true,
     false},
    {"springs_by_list", [] { return icosphere_mesh({.radius = 0.4, .frequency = 6}); }, false, false, true},
};

Scene scene_of(const BodyCase& c)
{
    Cloth body = Cloth::soft_body(c.mesh(), {}, {.node_mass = 0.01});
    body.springs.structural = {1000, 0.3};
    if (c.list) body.formulation = Formulation::spring_list;
    Scene scene;
    scene.method = c.constrained ? Method::volume : Method::mass_spring;
    if (c.rich) {
        body.body->internal = {InternalKind::nearest, 2, 0, 700, 0.2};
        body.body->volume.target = {{0, 1.0}, {1, 1.5}};
        body.body->volume.pressure = {{0, 300}, {1, 200}};
        body.body->volume.focus = VolumeFocus{{0.2, 0.2, 0}, 0.9};
        body.body->forces = {{{{-2, 0.1, -2}, {2, 2, 2}}, {1, 2, 3}, {0, 5, 1}}};
        body.pin(Attachment(std::uint32_t{1}, {{.time = 0}, {.time = 1, .position = {1, 0, 0}}}));
        body.pin(std::uint32_t{3});
        scene.air = {.velocity = {3, 0.5, -1}, .density = 1.2, .drag = 1.1, .lift = 0.4};
    }
    scene.add(body);
    scene.add(Plane{.point = {0, -0.25, 0}, .normal = {0.1, 1, 0}, .friction = 0.2});
    scene.add(Box{.centre = {-0.4, 0, 0}, .size = {0.2, 0.3, 0.3}, .rotation = {10, 20, 30}});
    scene.add(Sphere{.centre = {0.35, 0, 0.3}, .radius = 0.06, .response = ContactResponse::paper});
    return scene;
}

ClothModel shaken_model(const Scene& scene)
{
    ClothModel model(scene.cloth(0), scene);
    std::mt19937 engine(11);
    std::uniform_real_distribution<float> unit(-1, 1);
    const float shake = 0.05f * static_cast<float>(model.springs.list.front().rest_length);
    for (std::size_t i = 0; i < model.shape.positions.size(); ++i) {
        Vec3& x = model.shape.positions[i];
        x = {x.x + shake * unit(engine), x.y + shake * unit(engine), x.z + shake * unit(engine)};
        if (model.masses.inverse(i) > 0)
            model.shape.velocities[i] = {unit(engine), unit(engine), unit(engine)};
    }
    return model;
}

using Results = std::map<Resource, std::vector<float>>;

/// The results of two steps: the second uses the blocked directions of the first.
Results results_of(PassRunner& runner, const ClothModel& model, const Scene& scene)
{
    Program program{1, {}, 0};
    constexpr std::uint32_t steps = 2;
    program.parity_after = append_frame({&model, 1}, steps, 0, program.calls);
    std::vector<PlacedCollider> colliders;
    for (const Collider& collider : scene.colliders)
        colliders.push_back(seen_from(placed_at(collider, 0), {}));
    std::vector<std::vector<Vec3>> attached(1);
    std::vector<std::vector<VolumeGoal>> goals(1);
    for (std::uint32_t s = 1; s <= steps; ++s) {
        for (const AttachedNode& a : model.attachments.nodes) {
            const Vec3 x = model.shape.positions[a.node];
            attached[0].push_back({x.x + static_cast<float>(s * dt), x.y, x.z});
        }
        goals[0].push_back(model.body->goal_at(0, s * dt));
    }
    runner.run(program, {dt, static_cast<std::uint32_t>(colliders.size()), colliders, true, attached, goals});
    Results results;
    std::vector<Resource> computed = {Resource::position, Resource::velocity, Resource::cubic_sums,
                                      Resource::volumes, Resource::measures};
    if (model.plan.keeps_volume())
        computed.insert(computed.end(), {Resource::gradient, Resource::direction, Resource::blocked,
                                         Resource::rate_sums, Resource::bodies});
    if (model.has_external_force()) computed.push_back(Resource::external_force);
    for (const Resource resource : computed)
        runner.read(0, resource, program.parity_after, results[resource]);
    return results;
}

class BodyPassParity : public testing::TestWithParam<BodyCase> {};

TEST_P(BodyPassParity, AllBackendsAgree)
{
    const Scene scene = scene_of(GetParam());
    const ClothModel model = shaken_model(scene);
    Results expected;
    for (const test::CpuWay& way : test::cpu_ways()) {
        const Results results = results_of(*make_cpu_runner({&model, 1}, way.options()), model, scene);
        if (expected.empty()) expected = results;
        test::expect_same_bits(expected, results, testing::PrintToString(way));
    }
    if (test::has_vulkan)
        test::expect_same_bits(expected, results_of(*test::make_runner(Backend::vulkan, model), model, scene),
                               "vulkan");

    // Against the reference: forces of up to 40 springs of 1,000 N/m, each off by its stiffness times the
    // rounding of positions of up to 1 m, on the lightest node, for two steps; and as much again for
    // everything else.
    const Results exact = results_of(*make_reference_runner({&model, 1}), model, scene);
    const double rounding = 0x1p-24;
    double least_mass = 1e30;
    for (const double m : model.masses.kg) least_mass = std::min(least_mass, m);
    const double velocity_tolerance = 2 * 2 * 40 * 1000 * rounding * dt / least_mass + 256 * rounding;
    const auto expect_near = [&](Resource resource, double tolerance) {
        EXPECT_LE(test::largest_difference(expected.at(resource), exact.at(resource)), tolerance)
            << "resource " << static_cast<int>(resource);
    };
    // Over a step, the correction converts rounding of positions into velocity.
    const double correction = GetParam().constrained ? 16 * rounding / dt : 0;
    expect_near(Resource::velocity, velocity_tolerance + correction);
    expect_near(Resource::position, (velocity_tolerance + correction) * dt + 8 * rounding);
    // Normal and count of blocking colliders; no node is so close to a surface that rounding decides.
    if (GetParam().constrained) expect_near(Resource::blocked, 1e-4);
    expect_near(Resource::volumes, 1e-6 * exact.at(Resource::volumes)[0]);
}

INSTANTIATE_TEST_SUITE_P(Meshes, BodyPassParity, testing::ValuesIn(cases),
                         [](const auto& param) { return std::string(param.param.name); });

TEST(BodyPassTable, EveryPassOfBodiesIsRunByTheCasesAbove)
{
    std::map<Pass, int> runs;
    for (const BodyCase& c : cases) {
        if (std::string(c.name) == "uv_sphere_70000") continue;  // runs what others run
        const Scene scene = scene_of(c);
        const ClothModel model(scene.cloth(0), scene);
        std::vector<Call> calls;
        append_frame({&model, 1}, 1, 0, calls);
        for (const Call& call : calls) ++runs[call.pass];
    }
    for (std::size_t p = 0; p < all_passes().size(); ++p)
        if (is_body_pass(static_cast<Pass>(p))) {
            EXPECT_GT(runs[static_cast<Pass>(p)], 0) << all_passes()[p].name;
        }
}

TEST(BodyFormulations, GatheringAndTheSpringListGiveTheSameBits)
{
    Results results[2];
    for (const bool list : {false, true}) {
        const Scene scene = scene_of(
            {"", [] { return icosphere_mesh({.radius = 0.4, .frequency = 6}); }, false, false, list});
        const ClothModel model = shaken_model(scene);
        results[list] = results_of(*make_cpu_runner({&model, 1}, {}), model, scene);
    }
    test::expect_same_bits(results[0], results[1], "spring list");
}

}  // namespace
}  // namespace pliant
