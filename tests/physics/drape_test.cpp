// Rows "drape (Cusick)" (docs/verification.md): a round cloth of 30 cm lies on a disc of 18 cm, and its
// coefficient is what part of the overhanging ring its shadow covers (ISO 9073-9, BS 5058).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "physics/measured.hpp"
#include "physics/strips.hpp"

namespace pliant {
namespace {

constexpr double cloth_radius = 0.15, disc_radius = 0.09;  // m

/// Area in m2 that triangles cover seen from above, on a grid of 1 mm.
double shadow_of(std::span<const Triangle> triangles, const std::vector<Vec3d>& x)
{
    constexpr int cells = 400;
    constexpr double cell = 0.001, from = -0.2;
    std::vector<char> covered(cells * cells, 0);
    const auto place = [&](double a) { return (a - from) / cell - 0.5; };  // a cell counts by its middle
    for (const Triangle& t : triangles) {
        const double ax = place(x[t[0]].x), az = place(x[t[0]].z), bx = place(x[t[1]].x),
                     bz = place(x[t[1]].z), cx = place(x[t[2]].x), cz = place(x[t[2]].z);
        const double turn = (bx - ax) * (cz - az) - (bz - az) * (cx - ax);
        if (turn == 0) continue;
        const auto first = [](double a, double b, double c) {
            return std::max(0, static_cast<int>(std::ceil(std::min({a, b, c}))));
        };
        const auto last = [](double a, double b, double c) {
            return std::min(cells - 1, static_cast<int>(std::floor(std::max({a, b, c}))));
        };
        for (int i = first(ax, bx, cx); i <= last(ax, bx, cx); ++i)
            for (int j = first(az, bz, cz); j <= last(az, bz, cz); ++j) {
                const double u = ((i - ax) * (cz - az) - (j - az) * (cx - ax)) / turn;
                const double v = ((bx - ax) * (j - az) - (bz - az) * (i - ax)) / turn;
                if (u >= 0 && v >= 0 && u + v <= 1) covered[static_cast<std::size_t>(i * cells + j)] = 1;
            }
    }
    double area = 0;
    for (const char c : covered) area += c * cell * cell;
    return area;
}

/// The drape coefficient, 0 to 1, of a cloth held flat within the disc, which hangs from its rim until it is
/// at rest.
double drape_coefficient(Cloth cloth)
{
    cloth.damping = 1;
    Scene scene;
    scene.integrator = Integrator::implicit_euler;
    scene.time = {.duration = 10, .frame_rate = 20, .substeps = 1};
    scene.newton_multigrid.newton_iterations = 20;
    scene.newton_multigrid.newton_tolerance = 0.01;
    scene.newton_multigrid.linear_iterations = 40;
    Scene flat;
    flat.add(cloth);
    Simulation start(flat, test::on(Backend::cpu));
    const auto places = test::positions_of(start);
    for (std::uint32_t i = 0; i < places.size(); ++i)
        if (std::hypot(places[i].x, places[i].z) <= disc_radius) cloth.pin(i);
    scene.add(cloth);
    Simulation simulation(scene, test::on(Backend::cpu));
    for (int step = 0; step < 40; ++step) simulation.advance(0.05);
    EXPECT_LT(simulation.report().measures.max_speed, 0.1);
    const double disc = std::numbers::pi * disc_radius * disc_radius,
                 whole = std::numbers::pi * cloth_radius * cloth_radius;
    return (shadow_of(simulation.triangles(), test::positions_of(simulation)) - disc) / (whole - disc);
}

double drape_of(Material material, std::uint32_t rings)
{
    Cloth cloth = Cloth::disc({.radius = cloth_radius, .rings = rings});
    return drape_coefficient(cloth.make_of(material));
}

TEST(Drape, OfMaterialsIsInThePublishedRangesAtTwoResolutions)
{
    // Both the published ranges, and 5 % between resolutions, are in per cent of the ring, as the coefficient
    // itself is.
    const struct {
        Material material;
        const char* name;
        double least, most;
        bool settles;  ///< comes to the same shape at both resolutions
    } rows[] = {{Material::silk, "silk", 0.20, 0.40, true},
                {Material::cotton, "cotton", 0.60, 0.76, true},
                {Material::wool, "wool", 0.40, 0.70, true},
                {Material::denim, "denim", 0.70, 0.90, true},
                {Material::leather, "leather", 0.47, 0.70, false}};
    for (const auto& row : rows) {
        const double coarse = drape_of(row.material, 15), fine = drape_of(row.material, 20);
        test::measured(std::string("drape of ") + row.name + ", coarse", coarse);
        test::measured(std::string("drape of ") + row.name + ", fine", fine);
        if (row.settles) {
            EXPECT_NEAR(coarse, fine, 0.05) << row.name;
        }
        EXPECT_GE(std::min(coarse, fine), row.least) << row.name;
        EXPECT_LE(std::max(coarse, fine), row.most) << row.name;
    }
}

TEST(Drape, RisesWithBendingStiffness)
{
    double before = 0;
    for (const double bending : {2e-6, 8e-6, 3.2e-5, 1.28e-4}) {
        Cloth cloth = Cloth::disc({.radius = cloth_radius, .rings = 15});
        cloth.make_of(Material::cotton);
        cloth.springs.bending_stiffness = bending;
        const double drape = drape_coefficient(cloth);
        test::measured("drape of cotton, bending stiffness " + std::to_string(bending * 1e6) + " uN m",
                       drape);
        EXPECT_GT(drape, before + 0.05) << bending;
        before = drape;
    }
}

}  // namespace
}  // namespace pliant
