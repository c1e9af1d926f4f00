// Soft bodies in balance: Laplace's law of a skin under pressure, and a body between plates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics/measured.hpp"
#include "pliant/mesh_generators.hpp"
#include "test_cloths.hpp"
#include "test_differences.hpp"

namespace pliant {
namespace {

double length_of(Vec3d a) { return std::sqrt(dot(a, a)); }

/// A skin of springs under pressure, at rest.
struct Balloon {
    double growth = 0;  ///< of the radius of the ball of its volume, over that radius
    double roundness =
        0;              ///< farthest less nearest node from the centre, over the mean growth of that distance
    double virial = 0;  ///< J, sum of f l
    double volume = 0;  ///< m3
    double edge = 0;    ///< m, the mean length at rest
};
constexpr double pressure = 40, stiffness = 200, radius = 0.5;  // Pa, N/m, m

Balloon balloon(std::uint32_t frequency, Backend backend)
{
    const SurfaceMesh mesh = icosphere_mesh({.radius = radius, .frequency = frequency});
    BodyOptions options;
    options.volume.constraint = false;
    options.volume.pressure = {{0, pressure}};
    const double nodes = static_cast<double>(mesh.vertices.size());
    Cloth body = Cloth::soft_body(mesh, options, {.node_mass = 0.642 / nodes});
    body.springs.structural = {stiffness, 0.16 / frequency};
    body.damping = 20;
    Scene scene;
    scene.method = Method::volume;
    scene.gravity = {0, 0, 0};
    scene.time = {.duration = 2, .frame_rate = 100, .substeps = 0};
    scene.add(body);
    Simulation simulation(scene, test::on(backend));
    for (int frame = 0; frame < 300; ++frame) simulation.advance(0.01);
    EXPECT_LT(simulation.report().measures.max_speed, 1e-3);

    Balloon found;
    const auto x = simulation.positions();
    double volume_at_rest = 0, mean = 0;
    test::Smallest least;
    test::Largest most;
    for (const Triangle& t : mesh.triangles) {
        const Vec3d a = to_double(x[t[0]]), b = to_double(x[t[1]]), c = to_double(x[t[2]]);
        found.volume += dot(a, cross(b, c)) / 6;
        volume_at_rest += dot(to_double(mesh.vertices[t[0]]),
                              cross(to_double(mesh.vertices[t[1]]), to_double(mesh.vertices[t[2]]))) /
                          6;
        for (std::size_t side = 0; side < 3; ++side) {  // every edge is in two triangles
            const std::uint32_t i = t[side], j = t[(side + 1) % 3];
            const double length = length_of(to_double(x[i]) - to_double(x[j]));
            const double rest = length_of(to_double(mesh.vertices[i]) - to_double(mesh.vertices[j]));
            found.virial += stiffness * (length - rest) * length / 2;
            found.edge += rest / static_cast<double>(3 * mesh.triangles.size());
        }
    }
    for (const Vec3& a : x) {
        const double r = length_of(to_double(a));
        least.add(r);
        most.add(r);
        mean += r / nodes;
    }
    found.growth = std::cbrt(found.volume / volume_at_rest) - 1;
    found.roundness = (most.value() - least.value()) / (mean - radius);
    return found;
}

TEST(LaplaceBalance, TensionCarriesThePressure)
{
    // p = 2 T / R. The tension of a skin of springs is T = sum f l / (2 A); on a sphere A R = 3 V, so that
    // the law reads 3 p V = sum f l, which holds for any shape in balance (the virial theorem).
    const Balloon found = balloon(8, Backend::reference);
    test::measured("Laplace, sum f l against 3 p V", found.virial, 3 * pressure * found.volume);
    EXPECT_NEAR(found.virial, 3 * pressure * found.volume, 1e-3 * found.virial);
}

TEST(LaplaceBalance, AnIcosahedronStaysOneAndGrowsAsItsClosedFormSays)
{
    // All 30 edges, and all 12 nodes, are alike: nothing of the mesh can make it other than itself. Its edge
    // l solves 3 p V(l) = 30 k (l - l0) l with V = 5/12 (3 + sqrt 5) l^3: 3 p V1 l^2 - 30 k l + 30 k l0 = 0.
    const Balloon found = balloon(1, Backend::reference);
    const double v1 = 5.0 / 12 * (3 + std::sqrt(5.0)), a = 3 * pressure * v1, b = 30 * stiffness;
    const double l = (b - std::sqrt(b * b - 4 * a * b * found.edge)) / (2 * a);
    test::measured("icosahedron, growth", found.growth, l / found.edge - 1);
    test::measured("icosahedron, roundness over growth", found.roundness);
    // Places are read back as floats, 3e-8 m of 0.5 m, and the growth is 0.012 m: 5e-6 of it.
    EXPECT_NEAR(found.growth, l / found.edge - 1, 1e-5 * found.growth);
    EXPECT_LT(found.roundness, 1e-5);
}

TEST(LaplaceBalance, ASphereConvergesWithRefinement)
{
    // A lattice of equilateral triangles has T = sqrt(3) k e / (1 + e) when each edge is stretched by e, so
    // that a round skin grows by e = p R0 / (2 sqrt(3) k) (1 + e)^2. The triangles of an icosphere are not
    // equilateral, at any frequency: the sum of the squares of their sides over 4 sqrt(3) A, to which their
    // mean tension is proportional and which is 1 for equilateral ones, goes up to 1.0265 towards its twelve
    // nodes of five neighbours. So the closed form is right to 2.65 %, and what is not round does not vanish
    // with refinement, but converges, as growth does. The mesh is of second order in the edge: the difference
    // of two refinements falls by 4 in the limit, and at these frequencies by 2 at least.
    double e = 0;
    for (int round = 0; round < 50; ++round)
        e = pressure * radius / (2 * std::sqrt(3.0) * stiffness) * (1 + e) * (1 + e);
    std::vector<Balloon> found;
    for (const std::uint32_t frequency : {2u, 4u, 8u, 16u}) found.push_back(balloon(frequency, Backend::cpu));
    test::measured("Laplace, growth at the finest", found.back().growth, e);
    for (const Balloon& each : found) {
        test::measured("Laplace, growth", each.growth, e);
        test::measured("Laplace, roundness over growth", each.roundness);
    }
    EXPECT_NEAR(found.back().growth, e, 0.0265 * e);
    for (std::size_t k = 0; k + 2 < found.size(); ++k) {
        EXPECT_LT(std::abs(found[k + 2].growth - found[k + 1].growth),
                  0.5 * std::abs(found[k + 1].growth - found[k].growth))
            << k;
        EXPECT_LT(std::abs(found[k + 2].roundness - found[k + 1].roundness),
                  0.5 * std::abs(found[k + 1].roundness - found[k].roundness))
            << k;
    }
}

TEST(PressBalance, ASphereBetweenPlatesIsSymmetricAndBothPlatesCarryTheSame)
{
    // Two plates press a sphere from 1 m to 0.7 m, without gravity. What a plate carries is what its nodes
    // are given by springs and pressure, and these have no other balance than the plate; so the momentum of
    // the body says it: at rest the two forces differ by nothing but what still moves. Seen through the
    // shape: nodes in contact, and their places, mirror each other, and the volume is kept.
    const SurfaceMesh mesh = icosphere_mesh({.radius = 0.5, .frequency = 8});
    Cloth body = Cloth::soft_body(mesh, {}, {.node_mass = 0.01});
    body.springs.structural = {500, 0.5};
    body.damping = 5;
    body.thickness = 0;
    Scene scene;
    scene.method = Method::volume;
    scene.gravity = {0, 0, 0};
    scene.time = {.duration = 2, .frame_rate = 100, .substeps = 20};
    scene.add(body);
    for (const double side : {-1.0, 1.0})
        scene.add(Plane{.point = {0, side * 0.5, 0},
                        .normal = {0, -side, 0},
                        .friction = 0,
                        .keyframes = {{0, {}, {}}, {1, {0, -side * 0.15, 0}, {}}}});
    Simulation simulation(scene, test::on(Backend::reference));
    for (int frame = 0; frame < 300; ++frame) simulation.advance(0.01);
    const auto x = simulation.positions();
    double mean = 0;
    test::Largest upper;
    test::Smallest lower;
    int above = 0, below = 0, mirrored = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean += double{x[i].y} / static_cast<double>(x.size());
        if (x[i].y > 0.35 - 1e-5) ++above, upper.add(double{x[i].y});
        if (x[i].y < -0.35 + 1e-5) ++below, lower.add(double{x[i].y});
        // An icosphere is its own mirror image through the centre: so is the pressed one.
        for (std::size_t j = 0; j < x.size(); ++j) {
            const Vec3d sum = to_double(mesh.vertices[i]) + to_double(mesh.vertices[j]);
            if (dot(sum, sum) > 1e-10) continue;
            const Vec3d now = to_double(x[i]) + to_double(x[j]);
            EXPECT_LT(std::sqrt(dot(now, now)), 1e-4) << i;
            ++mirrored;
        }
    }
    EXPECT_EQ(mirrored, static_cast<int>(x.size()));
    EXPECT_EQ(above, below);
    EXPECT_GT(above, 20);
    EXPECT_NEAR(upper.value(), 0.35, 1e-5);
    EXPECT_NEAR(lower.value(), -0.35, 1e-5);
    EXPECT_NEAR(mean, 0, 1e-5);
    EXPECT_LT(simulation.report().volume.error_max, 1e-6);  // row "volume": 1e-4 promised, 1e-6 aimed at
    EXPECT_LT(simulation.report().measures.max_speed, 1e-3);

    // Force on a plate: springs of the nodes in contact, and the pressure on their share of the area, which
    // the volume constraint's multiplier stands for. Springs alone across the middle plane must carry what
    // both plates do, less the pressure there: by the balance of either half both plates carry the same.
    double force_above = 0, force_below = 0;
    for (const Triangle& t : mesh.triangles)
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint32_t i = t[side], j = t[(side + 1) % 3];
            if (i > j) continue;
            const Vec3d d = to_double(x[j]) - to_double(x[i]);
            const Vec3d r = to_double(mesh.vertices[j]) - to_double(mesh.vertices[i]);
            const double l = std::sqrt(dot(d, d)), f = 500 * (l - std::sqrt(dot(r, r)));
            const auto add = [&](std::uint32_t node, double sign) {
                if (x[node].y > 0.35 - 1e-5) force_above += sign * f * d.y / l;
                if (x[node].y < -0.35 + 1e-5) force_below += sign * f * d.y / l;
            };
            add(i, 1);
            add(j, -1);
        }
    test::measured("press, volume error", simulation.report().volume.error_max);
    test::measured("press, force above against below", force_above, -force_below);
    EXPECT_GT(std::abs(force_above), 1);

    EXPECT_NEAR(force_above, -force_below, 1e-3 * std::abs(force_above));
}

}  // namespace
}  // namespace pliant
