// Chains and strips that hang: what they weigh is what they carry, and the catenary.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "physics/backends.hpp"
#include "physics/measured.hpp"
#include "physics/strips.hpp"
#include "test_differences.hpp"

namespace pliant {
namespace {

class Hanging : public test::OnEveryBackend {};
INSTANTIATE_TEST_SUITE_P(Physics, Hanging, testing::ValuesIn(test::all_backends), test::backend_name);

TEST_P(Hanging, AHangingChainStretchesByTheWeightBelow)
{
    // A ladder of two columns pinned at the top: each rung's two vertical springs carry the weight of the
    // nodes below, l_r = l_0 (1 + ...), elongation of rung r: (R - r) m g / k per column. Shear and bend are
    // off.
    constexpr std::uint32_t rows = 9;
    constexpr double k = 40, m = 0.002, g = 9.81;
    Scene scene;
    scene.time = test::steps(60, 40);
    Cloth cloth = Cloth::sheet({.rows = rows, .columns = 2, .width = 0.1, .height = 0.8, .node_mass = m});
    cloth.rotation = {90, 0, 0};
    cloth.position = {0, 1, 0};
    cloth.springs = {{k, 0.05}, {0, 0}, {0, 0}};
    cloth.damping = 3;  // comes to rest
    cloth.pin(Edge::top);
    scene.add(cloth);
    Simulation simulation(scene, options());
    for (int frame = 0; frame < 600; ++frame) simulation.advance(1.0 / 60);
    double elongation = 0, expected = 0;
    const auto x = simulation.positions();
    for (std::uint32_t r = 1; r < rows; ++r) {
        expected += (rows - r) * m * g / k;
        elongation = x[0].y - x[2 * r].y - 0.1 * r;
        // At rest the sum is exact. In float a node stops where a step moves it by less than half an ulp of
        // 1 m, that is at a = 3e-8 m / dt^2 = 0.17 m/s2; nodes of 2 g on 40 N/m may keep (R - r) m a / k of
        // that per rung, 3e-4 m in all. Swinging carries them nearer: 2e-5 holds.
        EXPECT_NEAR(elongation, expected, exact() ? 1e-6 : 2e-5) << r;
    }
    EXPECT_LT(simulation.report().measures.max_speed, 1e-3);
}

TEST(HangingStrip, HasTheStrainOfItsWeight)
{
    // Row "hanging elastic strip": top strain rho g L / E2D, elongation half of it. Without shear springs a
    // sheet is a bundle of threads, E2D = k where cells are square. A link carries what hangs below its
    // middle, so that the strain at the top is found by going on half a link from the two highest ones.
    constexpr std::uint32_t rows = 41;
    constexpr double length = 1, density = 0.5, k = 50, g = 9.81;
    Scene scene;
    scene.add(test::hanging_strip(rows, 2, length / (rows - 1), length, density, k, 0));
    test::seek_rest(scene);
    const auto x = test::at_rest(scene, 12);
    const auto height = [&](std::uint32_t row) { return x[2 * row].y; };
    const double link = length / (rows - 1), strain = density * g * length / k;
    const double first = (height(0) - height(1)) / link - 1, second = (height(1) - height(2)) / link - 1;
    test::measured("hanging strip, top strain", first + (first - second) / 2, strain);
    test::measured("hanging strip, elongation", (height(0) - height(rows - 1)) / length - 1, strain / 2);
    EXPECT_NEAR(first + (first - second) / 2, strain, 1e-3 * strain);
    EXPECT_NEAR((height(0) - height(rows - 1)) / length - 1, strain / 2, 1e-3 * strain / 2);
}

struct Catenary {
    double length, sag, tension;  ///< of span 1; tension at the ends over the weight of a length of 1
};
// Rows "catenary".
constexpr Catenary catenaries[] = {{1.05, 0.139304, 1.058944},
                                   {1.2, 0.292344, 0.761885},
                                   {1.5, 0.502633, 0.810870},
                                   {2, 0.796388, 1.026029}};

/// A chain of `links` links between two level ends at distance 1.
Catenary hang(double length, std::uint32_t links, Backend backend)
{
    // A link carries little, so that it does not give: 0.01 N on 1e-6 m/N is 1e-8 m.
    constexpr double weight = 0.01, width = 0.1;  // N/m
    Cloth cloth = Cloth::sheet({.rows = links + 1,
                                .columns = 2,
                                .width = width,
                                .height = length,
                                .border = SheetBorder::half,
                                .density = weight / 9.81 / width});
    cloth.springs = {};
    cloth.springs.structural = {0, 0, SpringRole::constraint, 0, 1e-6};
    cloth.springs.shear.role = cloth.springs.bend.role = SpringRole::off;
    cloth.damping = 2;
    cloth.pin(Attachment(Edge::top, {{.time = 0}, {.time = 2, .position = {0, 0, (length - 1) / 2}}}));
    cloth.pin(Attachment(Edge::bottom, {{.time = 0}, {.time = 2, .position = {0, 0, -(length - 1) / 2}}}));
    Scene scene;
    scene.method = Method::constraint;
    scene.add(cloth);
    test::seek_rest(scene, 0.1);
    scene.newton_multigrid.newton_tolerance = 1e-6;
    Simulation simulation(scene, test::on(backend));
    for (int step = 0; step < 60; ++step) simulation.advance(0.1);
    test::Smallest lowest;
    for (const Vec3& x : simulation.positions()) lowest.add(double{x.y});
    // Each of the two columns carries half; the last link is half a link away from the end, and between its
    // middle and the end the vertical part of the tension grows by the weight of that half.
    const double last = 2.0 * simulation.multipliers()[2];  // at the first node that is free
    const double vertical = weight * (length / 2 - length / links / 2);
    const double level = std::sqrt(last * last - vertical * vertical);
    return {length, -lowest.value(), std::hypot(level, weight * length / 2) / weight};
}

TEST(CatenaryRows, SagAndTensionAreWithinAThousandth)
{
    for (const Catenary& expected : catenaries) {
        const Catenary found = hang(expected.length, 40, Backend::reference);
        const std::string name = "catenary of length " + std::to_string(expected.length);
        test::measured(name + ", sag", found.sag, expected.sag);
        test::measured(name + ", tension", found.tension, expected.tension);
        EXPECT_NEAR(found.sag, expected.sag, 1e-3 * expected.sag) << expected.length;
        EXPECT_NEAR(found.tension, expected.tension, 1e-3 * expected.tension) << expected.length;
    }
}

TEST(CatenaryRows, ErrorFallsWithTheSquareOfALink)
{
    const Catenary expected = catenaries[1];
    double before = 0, links_before = 0;
    for (const std::uint32_t links : {4u, 6u, 10u, 16u, 24u}) {
        const double error = std::abs(hang(expected.length, links, Backend::reference).sag - expected.sag);
        if (links_before > 0) {
            const double slope = std::log(before / error) / std::log(links / links_before);
            test::measured("catenary, order of the sag, " + std::to_string(links) + " links", slope, 2);
            EXPECT_NEAR(slope, 2, 0.2) << links;
        }
        before = error;
        links_before = links;
    }
}

}  // namespace
}  // namespace pliant
