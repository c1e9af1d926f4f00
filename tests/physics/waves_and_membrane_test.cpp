// Transverse waves: along a stretched chain, and of a membrane under tension.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "physics/backends.hpp"
#include "physics/measured.hpp"
#include "solve/frame.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

/// Frequency of a standing wave, 1/s. Every node starts at the place that `stretch` times the sheet at rest
/// gives it, with the speed of the wave's shape; the wave's amplitude passes 0 twice in a period.
double frequency(ClothModel model, double stretch, int waves_across, int waves_along, double dt, int periods)
{
    const std::uint32_t rows = model.shape.sheet->rows, columns = model.shape.sheet->columns;
    std::vector<double> shape(model.node_count());
    for (std::uint32_t r = 0; r < rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c) {
            const std::uint32_t node = r * columns + c;
            const double across =
                waves_across > 0 ? std::sin(std::numbers::pi * waves_across * c / (columns - 1.0)) : 1;
            shape[node] = across * std::sin(std::numbers::pi * waves_along * r / (rows - 1.0));
            const Vec3d x = to_double(model.shape.positions[node]);
            model.shape.positions[node] =
                to_float({waves_across > 0 ? x.x * stretch : x.x, x.y, x.z * stretch});
            // So small that the tension does not change: slopes of some 1e-4.
            if (model.masses.inverse(node) > 0)
                model.shape.velocities[node] = {0, static_cast<float>(1e-3 * shape[node]), 0};
        }
    const auto runner = make_reference_runner({&model, 1});
    Program programs[2] = {{1, {}, 0}, {2, {}, 1}};
    for (std::uint32_t parity = 0; parity < 2; ++parity)
        programs[parity].parity_after = append_frame({&model, 1}, 1, parity, programs[parity].calls);
    std::uint32_t parity = 0;
    std::vector<float> x;
    double before = 0, first = -1, last = -1;
    int crossings = 0;
    for (int n = 1; crossings <= periods; ++n) {
        runner->run(programs[parity], {dt, 0, {}, true});
        parity = programs[parity].parity_after;
        runner->read(0, Resource::position, parity, x);
        double amplitude = 0;
        for (std::size_t node = 0; node < shape.size(); ++node) amplitude += shape[node] * x[3 * node + 1];
        if (before < 0 && amplitude >= 0) {
            const double t = (n - 1 + before / (before - amplitude)) * dt;
            if (crossings++ == 0) first = t;
            last = t;
        }
        before = amplitude;
        if (n > 200'000) return 0;
    }
    return periods / (last - first);
}

TEST(Waves, AlongAStretchedChainHaveTheSpeedOfItsTension)
{
    // c^2 = T / rho. Two columns of nodes, held at both ends, stretched by a tenth: T = k e for each column,
    // and its mass is spread over the longer link. A wave of n links has the frequency of the continuum but
    // for (pi / n)^2 / 6.
    constexpr std::uint32_t rows = 61;
    constexpr double k = 100, m = 0.001, e = 0.1, link = 1.0 / (rows - 1);
    Cloth cloth = Cloth::sheet({.rows = rows, .columns = 2, .width = 0.1, .height = 1, .node_mass = m});
    cloth.springs = {{k, 0}, {0, 0}, {0, 0}};
    cloth.damping = 0;
    cloth.pin(Edge::top).pin(Edge::bottom);
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.add(cloth);
    const double tension = k * e * link, density = m / (link * (1 + e)), c = std::sqrt(tension / density);
    for (const int halves : {1, 2, 3, 6}) {  // 120, 60, 40 and 20 links to a wave
        const double wavelength = 2 * (1 + e) / halves;
        const double f = frequency({scene.cloth(0), scene}, 1 + e, 0, halves, 2e-4, 4);
        test::measured("wave speed along a chain, half waves " + std::to_string(halves), f * wavelength, c);
        EXPECT_NEAR(f * wavelength / c, 1, 0.01) << halves;
    }
}

TEST(Membrane, HasTheFrequenciesOfItsTension)
{
    // Row "membrane under tension": f_mn = c/2 sqrt((m/a)^2 + (n/b)^2), 1 % at 20 nodes to a wave. A net of
    // structural springs stretched by e both ways: T = k e / (1 + e) across a width of 1, rho = mass / (1 +
    // e)^2.
    constexpr std::uint32_t n = 31;
    constexpr double k = 100, m = 0.001, e = 0.1, link = 1.0 / (n - 1);
    Cloth cloth = Cloth::sheet({.rows = n, .columns = n, .width = 1, .height = 1, .node_mass = m});
    cloth.springs = {{k, 0}, {0, 0}, {0, 0}};
    cloth.damping = 0;
    for (const Edge edge : {Edge::top, Edge::bottom, Edge::left, Edge::right}) cloth.pin(edge);
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.add(cloth);
    const double tension = k * e / (1 + e), side = 1 + e, density = m / std::pow(link * side, 2);
    const double c = std::sqrt(tension / density);
    for (const auto& [across, along] : {std::pair{1, 1}, {1, 2}, {2, 2}, {3, 1}, {3, 3}}) {
        const double expected = c / 2 * std::hypot(across / side, along / side);
        const double f = frequency({scene.cloth(0), scene}, 1 + e, across, along, 2e-4, 3);
        test::measured("membrane f " + std::to_string(across) + std::to_string(along), f, expected);
        EXPECT_NEAR(f, expected, 0.01 * expected) << across << ", " << along;
    }
}

}  // namespace
}  // namespace pliant
