// Bending against the heavy elastica, and the standard test of textiles that is made of it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "body/cloth_model.hpp"
#include "physics/measured.hpp"
#include "physics/strips.hpp"
#include "solve/frame.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

struct Cantilever {
    double drop = 0, reach = 0;  ///< of the tip below and beside the clamp, over the length
};

/// A strip of length 1, clamped level at one end, heavy: gamma = w L^3 / B.
Scene cantilever_scene(double gamma, std::uint32_t columns)
{
    // Held are the first two columns of nodes: the clamp is midway between them, where the midpoint rule that
    // the energy of three nodes is begins.
    const double h = 1 / (columns - 1.5);
    SheetOptions options;
    options.rows = 2;
    options.columns = columns;
    options.width = 1 + h / 2;
    options.height = h;
    options.border = SheetBorder::half;
    options.density = 1;  // kg/m2
    Cloth cloth = Cloth::sheet(options);
    cloth.position = {0.5 * options.width - h / 2, 0, 0};
    cloth.damping = 0;
    cloth.springs = {{1e5, 0}, {5e4, 0}, {0, 0}};  // stretches by 1e-4 under its own weight
    cloth.springs.bend_model = BendModel::quadratic;
    cloth.springs.bending_stiffness = 9.81 / gamma;
    for (const std::uint32_t node : {0u, 1u, columns, columns + 1}) cloth.pin(node);
    Scene scene;
    scene.add(cloth);
    test::seek_rest(scene);
    return scene;
}

Cantilever cantilever(double gamma, std::uint32_t columns, Backend backend = Backend::reference)
{
    const auto x = test::at_rest(cantilever_scene(gamma, columns), 12, backend);
    const Vec3d tip = x[columns - 1];
    return {-tip.y, tip.x};
}

/// The same of triangles, several of them across.
Cantilever mesh_cantilever(double gamma, std::uint32_t columns)
{
    const std::uint32_t rows = 5;
    const double h = 1 / (columns - 1.5), width = 1 + h / 2;
    Cloth cloth = Cloth::mesh(test::grid_mesh(rows, columns, width, 4 * h), {.density = 1});
    cloth.position = {0.5 * width - h / 2, 0, 0};
    cloth.damping = 0;
    cloth.springs = {{1e5, 0}, {0, 0}, {0, 0}};
    cloth.springs.bend_model = BendModel::quadratic;
    cloth.springs.bending_stiffness = 9.81 / gamma;
    for (std::uint32_t row = 0; row < rows; ++row) cloth.pin(row * columns).pin(row * columns + 1);
    Scene scene;
    scene.add(cloth);
    test::seek_rest(scene);
    const auto x = test::at_rest(scene, 12);
    const Vec3d tip = x[2 * columns + columns - 1];
    return {-tip.y, tip.x};
}

// Rows "heavy elastica": tip drop over L by gamma, and height over width.
struct Elastica {
    double gamma, drop;
};
constexpr Elastica elasticas[] = {{0.1, 0.01250}, {1, 0.12347},   {2, 0.23851},   {5, 0.49590},
                                  {10, 0.70020},  {20, 0.82988},  {50, 0.90791},  {100, 0.93752},
                                  {200, 0.95676}, {500, 0.97310}, {1000, 0.98112}};

TEST(HeavyElastica, TipDropsAsTheReferenceSays)
{
    for (const Elastica& e : elasticas) {
        const double drop = cantilever(e.gamma, 64).drop;
        test::measured("heavy elastica, gamma " + std::to_string(e.gamma) + ", drop / L", drop, e.drop);
        EXPECT_NEAR(drop, e.drop, 0.01) << "gamma " << e.gamma;
    }
}

TEST(HeavyElastica, HasTheMasterCurve)
{
    const std::pair<double, double> slopes[] = {{1, 0.1246}, {10, 1.0668}, {100, 5.888}, {1000, 21.33}};
    for (const auto& [gamma, slope] : slopes) {
        const Cantilever tip = cantilever(gamma, 97);
        test::measured("master curve, gamma " + std::to_string(gamma), tip.drop / tip.reach, slope);
        EXPECT_NEAR(tip.drop / tip.reach, slope, 0.02 * slope) << "gamma " << gamma;
    }
}

TEST(HeavyElastica, ErrorFallsAtLeastWithTheSquareOfTheDistanceOfNodes)
{
    // Four refinements, as long as the error is above what the stretch of 1e-4 and the reference's five
    // digits leave.
    for (const Elastica& e : {elasticas[4], elasticas[7]}) {
        double before = 0, h_before = 0;
        for (const std::uint32_t columns : {9u, 17u, 33u, 65u, 129u}) {
            const double h = 1 / (columns - 1.5);
            const double error = std::abs(cantilever(e.gamma, columns).drop - e.drop);
            if (before != 0 && !(error <= 5e-5)) {
                const double slope = std::log(before / error) / std::log(h_before / h);
                test::measured("elastica, order at gamma " + std::to_string(e.gamma) + ", " +
                                   std::to_string(columns) + " columns",
                               slope, 2);
                EXPECT_GT(slope, 1.8) << "gamma " << e.gamma << ", " << columns;
            }
            before = error;
            h_before = h;
        }
        EXPECT_LT(before, 1e-4) << e.gamma;
    }
}

TEST(HeavyElastica, OfATriangleMeshToo)
{
    for (const Elastica& e : {elasticas[1], elasticas[4], elasticas[7]}) {
        const double drop = mesh_cantilever(e.gamma, 33).drop;
        test::measured("heavy elastica, mesh, gamma " + std::to_string(e.gamma), drop, e.drop);
        EXPECT_NEAR(drop, e.drop, 0.01) << "gamma " << e.gamma;
    }
}

TEST(BendingLength, OfTheStandardTestIsFound)
{
    // Row "ASTM D1388 / Peirce": the chord from the clamp to the tip has 41.5 degrees at gamma = 8.0042. Two
    // gammas around it, and the one between them where the angle is that; the bending length goes with its
    // third root.
    const auto angle = [](double gamma) {
        const Cantilever tip = cantilever(gamma, 64);
        return std::atan2(tip.drop, tip.reach) * 180 / std::numbers::pi;
    };
    const double low = 7.6, high = 8.4, a = angle(low), b = angle(high);
    const double gamma = low + (41.5 - a) / (b - a) * (high - low);
    test::measured("ASTM D1388, bending length", std::cbrt(gamma / 8.0042), 1);
    EXPECT_NEAR(std::cbrt(gamma / 8.0042), 1, 0.01);
}

TEST(SkipSprings, CannotBendAsClothDoes)
{
    // Twice the load makes a cloth that is hardly bent sag twice as much: 0.01250 at gamma 0.1 and 0.12347
    // at 1. A skip spring shortens by the square of the angle, so that its energy goes with the fourth power,
    // and sag with the third root of the load: ten times the load, 2.15 times the sag, whatever the
    // stiffness. No stiffness passes both rows.
    double drops[2];
    for (const int k : {0, 1}) {
        Scene scene = cantilever_scene(1, 17);
        Cloth& cloth = *scene.cloth_handle(0);
        cloth.springs.bend_model = BendModel::skip_spring;
        cloth.springs.bend = {4e4, 0};
        scene.gravity = {0, k == 0 ? -9.81e-4 : -9.81e-3, 0};
        scene.newton_multigrid.newton_iterations = 20;
        scene.newton_multigrid.newton_tolerance = 1e-5;
        const auto x = test::at_rest(scene, 60);
        drops[k] = -x[16].y;
        EXPECT_GT(drops[k], 0.005) << "hardly bent at all";
        EXPECT_LT(drops[k], 0.4) << "not hardly bent";
    }
    test::measured("skip springs, sag at ten times the load", drops[1] / drops[0], 9.88);
    EXPECT_LT(drops[1] / drops[0], 4);  // a bending stiffness would give 9.88
}

TEST(Bending, BackendsHaveEqualBits)
{
    for (const Method method : {Method::mass_spring, Method::constraint}) {
        Scene scene;
        scene.method = method;
        Cloth cloth = test::flat_sheet(9, 14, 0.3, 0.2);
        cloth.make_of(Material::cotton);
        cloth.pin(Corner::top_left).pin(Corner::top_right);
        scene.add(cloth);
        Simulation cpu(scene, test::on(Backend::cpu)), vulkan(scene, test::on(Backend::vulkan));
        for (int frame = 0; frame < 3; ++frame) {
            cpu.advance(1 / 60.0);
            vulkan.advance(1 / 60.0);
            ASSERT_TRUE(cpu.report().finite);
            ASSERT_EQ(cpu.state_hash(), vulkan.state_hash()) << name_of(method) << ", frame " << frame;
        }
        EXPECT_GT(cpu.report().measures.max_speed, 0.1);
        EXPECT_EQ(vulkan.report().validation_messages, 0U);
    }
}

TEST(Bending, OfAFlatMeshIsNothing)
{
    // Of triangles that are no two alike, turned out of its plane of rest. Sums over cotangents cancel to
    // some roundings of the largest of them.
    SurfaceMesh flat = test::irregular_mesh(9, 7);
    for (Vec3& x : flat.vertices) x.y = 0;
    Cloth cloth = Cloth::mesh(flat, {.density = 0.3});
    cloth.springs = {{0, 0}, {0, 0}, {0, 0}};
    cloth.springs.bend_model = BendModel::quadratic;
    cloth.springs.bending_stiffness = 1;
    cloth.rotation = {30, 40, 50};
    Scene scene;
    scene.gravity = {};
    scene.time.substeps = 1;
    scene.add(cloth);
    Simulation simulation(scene, test::on(Backend::reference));
    const double at_rest = simulation.report().measures.elastic_energy;
    State bent = simulation.state();
    bent.cloths[0].positions[31].y += 1e-3f;
    simulation.set_state(bent);
    EXPECT_GT(simulation.report().measures.elastic_energy, 1e-6);
    EXPECT_LT(std::abs(at_rest), 1e-4 * simulation.report().measures.elastic_energy);
}

TEST(Bending, EnergyIsThatOfTheCurvature)
{
    // A sheet rolled to a radius r, which stretches nothing but by h^2: B / (2 r^2) per area.
    // By rows, by columns, and of a mesh of hinges.
    constexpr double radius = 0.4, bending = 2e-3, width = 0.5, height = 0.3;
    for (const int kind : {0, 1, 2}) {
        const std::uint32_t rows = 25, columns = 41;
        Cloth cloth = Cloth::sheet({.rows = rows,
                                    .columns = columns,
                                    .width = width,
                                    .height = height,
                                    .border = SheetBorder::half});
        if (kind == 2) cloth = Cloth::mesh(test::grid_mesh(rows, columns, width, height));
        cloth.springs = {{0, 0}, {0, 0}, {0, 0}};
        cloth.springs.bend_model = BendModel::quadratic;
        cloth.springs.bending_stiffness = bending;
        Scene scene;
        scene.add(cloth);
        ClothModel model(scene.cloth(0), scene);
        for (Vec3& x : model.shape.positions) {
            const double along = kind == 1 ? x.z : x.x, a = along / radius;
            const double u = radius * std::sin(a), y = radius * (1 - std::cos(a));
            x = kind == 1 ? to_float({x.x, y, u}) : to_float({u, y, x.z});
        }
        const auto runner = make_reference_runner({&model, 1});
        Program program{1, {}, 0};
        append_frame({&model, 1}, 1, 0, program.calls);
        runner->run(program, {1e-12, 0, {}, true});
        // The energy has no share of the half cells along the two free ends, where there is no moment.
        const double length = kind == 1 ? height * (1 - 1.0 / (rows - 1)) : width * (1 - 1.0 / (columns - 1));
        const double area = length * (kind == 1 ? width : height);
        // Of a mesh, triangles along the free border give less than their area, as far as their sides do not
        // say.
        const double expected = bending / (2 * radius * radius) * area;
        test::measured("energy of a roll, kind " + std::to_string(kind), runner->measures(0).elastic_energy,
                       expected);
        EXPECT_NEAR(runner->measures(0).elastic_energy, expected, (kind == 2 ? 0.04 : 0.01) * expected)
            << kind;
    }
}

}  // namespace
}  // namespace pliant
