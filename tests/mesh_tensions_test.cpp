// The memory of a mesh's limits over 10,000 steps: docs/physics.md, "Constraints".
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pliant/mesh_generators.hpp"
#include "pliant/simulation.hpp"

namespace pliant {
namespace {

constexpr std::uint32_t rings = 6, hem = 1 + 3 * (rings - 1) * rings;  // the first node of the disc's hem
constexpr double radius = 0.5;

Cloth disc() { return Cloth::disc({.radius = radius, .rings = rings, .density = 0.3}); }

Scene scene_of(Cloth cloth, double compliance)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.time.substeps = 1;
    cloth.springs = {{0, 0}, {0, 0}, {1, 0}};
    cloth.springs.structural.compliance = compliance;
    cloth.damping = 0.5;
    scene.add(std::move(cloth));
    return scene;
}

/// N, for each thousand steps: the root mean square of multipliers at nodes, every tenth step.
std::vector<double> tensions_of(Simulation& simulation)
{
    constexpr int thousands = 10, steps = 1000, every = 10;
    std::vector<double> tensions;
    for (int k = 0; k < thousands; ++k) {
        double sum = 0;
        for (int step = 0; step < steps; ++step) {
            simulation.advance(1.0 / 60);
            if (step % every > 0) continue;
            const auto multipliers = simulation.multipliers();
            double squares = 0;
            for (const float a : multipliers) squares += double{a} * a;
            sum += squares / static_cast<double>(multipliers.size());
        }
        tensions.push_back(std::sqrt(sum * every / steps));
        EXPECT_TRUE(simulation.report().finite);
    }
    return tensions;
}

/// From the third thousand on, each thousand steps have the overall mean tension, within `part`.
void expect_settled(const std::vector<double>& tensions, double part)
{
    constexpr std::size_t begun = 2;
    double mean = 0;
    for (std::size_t k = begun; k < tensions.size(); ++k)
        mean += tensions[k] / static_cast<double>(tensions.size() - begun);
    EXPECT_GT(mean, 0);
    for (std::size_t k = begun; k < tensions.size(); ++k)
        EXPECT_NEAR(tensions[k], mean, part * mean) << "steps " << k << ",000 to " << k + 1 << ",000";
}

// A drum: a disc pinned at its hem. All springs are taut, and they outnumber the degrees of freedom, so there
// are self-stresses. After it has come to rest they must not change by more than 1e-4: lengths are
// differences of floats (6e-8 m of 0.5 m), whose rounding is 6e-5 of a strain of 8e-5, and averages out over
// thousands of springs.
TEST(MeshTensions, OfADrumStay)
{
    Cloth cloth = disc();
    for (std::uint32_t k = hem; k < hem + 6 * rings; ++k) cloth.pin(k);
    Simulation simulation(scene_of(std::move(cloth), 1e-6), {.backend = Backend::cpu, .threads = 1});
    std::size_t springs = 0;
    for (const SpringListing& s : simulation.springs())
        if (s.kind == SpringKind::structural && (s.i < hem || s.j < hem)) ++springs;
    ASSERT_GT(springs, 3u * hem + hem / 8) << "tensions are not unique by far";
    expect_settled(tensions_of(simulation), 1e-4);
    EXPECT_LT(simulation.report().measures.max_speed, 1e-4);
}

// Cloths that hang from one or two nodes and do not come to rest: waves of about 0.2 m/s remain. Means over a
// thousand steps scatter by 2 to 4 %. (A drum's drift would be proportional to the tension in each step; 1e-4
// of it would give 2.5 times the tension by the end.)
TEST(MeshTensions, OfWhatHangsDoNotRunAway)
{
    Cloth hung = disc();
    hung.pin(hem).pin(hem + 3 * rings);
    Cloth closed = Cloth::mesh(
        torus_mesh({.major_radius = radius, .major_segments = 16, .minor_segments = 8}), {.density = 0.3});
    closed.pin(0u);
    for (Cloth* cloth : {&hung, &closed}) {
        Simulation simulation(scene_of(*cloth, 1e-8), {.backend = Backend::cpu, .threads = 1});
        expect_settled(tensions_of(simulation), 0.1);
        EXPECT_LT(simulation.report().measures.max_stretch, 0.005);
    }
}

}  // namespace
}  // namespace pliant
