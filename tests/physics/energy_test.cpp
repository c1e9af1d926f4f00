// Energy: kept where nothing takes it, falling where something does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics/measured.hpp"
#include "test_cloths.hpp"
#include "test_differences.hpp"

namespace pliant {
namespace {

/// J, of all kinds.
double energy_of(const Simulation& simulation)
{
    const auto& m = simulation.report().measures;
    return m.kinetic_energy + m.elastic_energy + m.potential_energy;
}

TEST(Energy, OfAnUndampedSheetHasNoTrend)
{
    // A symplectic method keeps a modified energy: the error oscillates with O(dt) and does not drift.
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.time = {.duration = 1, .frame_rate = 60, .substeps = 80};
    Cloth cloth = Cloth::sheet({.rows = 6, .columns = 7, .node_mass = 0.01});
    cloth.springs = {{50, 0}, {25, 0}, {1, 0}};
    cloth.damping = 0;
    cloth.pin(Corner::top_left).pin(Corner::bottom_right);
    auto handle = scene.add(cloth);
    handle->velocity = {0.2, 0.1, -0.1};
    SimulationOptions options;
    options.backend = Backend::reference;
    Simulation simulation(scene, options);
    const double start = energy_of(simulation);
    double first_half = 0, second_half = 0;
    for (int frame = 0; frame < 1200; ++frame) {
        simulation.advance(1.0 / 60);
        EXPECT_NEAR(energy_of(simulation) / start, 1, 0.02);
        (frame < 600 ? first_half : second_half) += energy_of(simulation) / 600;
    }
    EXPECT_NEAR(second_half / first_half, 1, 0.002);
}

TEST(Energy, OfADampedSheetNeverRises)
{
    // Springs' damping alone, of a sheet that starts to move all at once. Between two looks a sixtieth apart
    // symplectic Euler's own swing of the energy is omega dt of what oscillates, less than what damping
    // takes.
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.time = {.duration = 1, .frame_rate = 60, .substeps = 200};
    Cloth cloth = Cloth::sheet({.rows = 6, .columns = 7, .node_mass = 0.01});
    cloth.springs = {{50, 0.05}, {25, 0.05}, {1, 0.01}};
    cloth.damping = 0.5;
    cloth.velocity = {0.2, 0.1, -0.1};
    cloth.pin(Corner::top_left).pin(Corner::bottom_right);
    scene.add(cloth);
    Simulation simulation(scene, test::on(Backend::reference));
    const double start = energy_of(simulation);
    double before = start;
    for (int frame = 0; frame < 300; ++frame) {
        simulation.advance(1.0 / 60);
        EXPECT_LE(energy_of(simulation), before * (1 + 1e-12)) << frame;
        before = energy_of(simulation);
    }
    EXPECT_LT(before, 0.1 * start);
}

/// Energy every twelfth of a second, J, of a sheet of 1 m, held at two corners, let go from the horizontal.
std::vector<double> energies(const NewtonMultigridOptions& options)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.newton_multigrid = options;
    auto cloth = scene.add(Cloth::sheet({.rows = 32, .columns = 32, .density = 0.3}));
    cloth->springs.bend = {1, 0};
    cloth.pin(Corner::top_left).pin(Corner::top_right);
    Simulation simulation(scene, test::on(Backend::cpu));
    std::vector<double> list;
    for (int frame = 0; frame < 60; ++frame) {
        simulation.advance(1 / 60.0);
        if (frame % 5 == 4) list.push_back(energy_of(simulation));
    }
    return list;
}

TEST(Energy, WhatTheSolverLosesIsLessThanTwoPerCent)
{
    // Row "solver honesty": energy lost against a converged run, < 2 % of m g L. The default stops after 8
    // iterations of Newton's method, each of 6 V-cycles, for the sake of time, and misses this bar in the
    // first second by as much as is measured here, but keeps within 5 %; 12 iterations of 8 V-cycles keep it
    // (docs/verification.md). A run that is converged further differs from this one by 1e-4 of m g L.
    const auto converged = energies({.newton_iterations = 20,
                                     .newton_tolerance = 1e-3,
                                     .linear_iterations = 60,
                                     .linear_tolerance = 1e-2});
    const auto most_lost = [&](const NewtonMultigridOptions& options) {
        const auto found = energies(options);
        const double weight = 0.3 * 9.81;  // m g L
        return test::largest_difference(found, converged) / weight;
    };
    const double usual = most_lost({}), enough = most_lost({.newton_iterations = 12, .linear_iterations = 8});
    test::measured("energy lost by the default, over m g L", usual);
    test::measured("energy lost by 12 iterations of 8 V-cycles, over m g L", enough);
    EXPECT_LT(enough, 0.02);
    EXPECT_LT(usual, 0.05);
    EXPECT_GT(usual, 1e-4);  // steps that are left unsolved are another run
}

}  // namespace
}  // namespace pliant
