// Energy: kept where nothing takes it, falling where something does.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "physics/measured.hpp"
#include "test_cloths.hpp"

namespace pliant {
namespace {

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
    const auto energy = [&] {
        return simulation.report().measures.kinetic_energy + simulation.report().measures.elastic_energy;
    };
    const double start = energy();
    double first_half = 0, second_half = 0;
    for (int frame = 0; frame < 1200; ++frame) {
        simulation.advance(1.0 / 60);
        EXPECT_NEAR(energy() / start, 1, 0.02);
        (frame < 600 ? first_half : second_half) += energy() / 600;
    }
    EXPECT_NEAR(second_half / first_half, 1, 0.002);
}

double energy_of(const Simulation& simulation)
{
    const auto& m = simulation.report().measures;
    return m.kinetic_energy + m.elastic_energy + m.potential_energy;
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

/// Energy after each quarter of a second of a sheet of 1 m, held at two corners, let go from the horizontal,
/// J.
std::vector<double> energies(std::uint32_t newton, double newton_tolerance, std::uint32_t linear,
                             double linear_tolerance)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.newton_multigrid.newton_iterations = newton;
    scene.newton_multigrid.newton_tolerance = newton_tolerance;
    scene.newton_multigrid.linear_iterations = linear;
    scene.newton_multigrid.linear_tolerance = linear_tolerance;
    auto cloth = scene.add(Cloth::sheet({.rows = 32, .columns = 32, .density = 0.3}));
    cloth->springs.bend = {1, 0};
    cloth.pin(Corner::top_left).pin(Corner::top_right);
    Simulation simulation(scene, test::on(Backend::cpu));
    std::vector<double> list;
    for (int frame = 0; frame < 60; ++frame) {
        simulation.advance(1 / 60.0);
        if (frame % 15 == 14) list.push_back(energy_of(simulation));
    }
    return list;
}

TEST(Energy, WhatTheSolverLosesIsLessThanTwoPerCent)
{
    // Row "solver honesty": energy lost against a converged run, < 2 % of m g L, with the default tolerances
    // and as many V-cycles as they take. The default allows six of them for the sake of time and misses this
    // bar: by how much is measured here, and said in docs/verification.md.
    const auto usual = energies(7, 0.1, 6, 0.2), enough = energies(7, 0.1, 60, 0.2),
               converged = energies(20, 1e-3, 60, 1e-2);
    const double weight = 0.3 * 9.81;  // m g L
    for (std::size_t k = 0; k < usual.size(); ++k) {
        test::measured("energy lost by the default, over m g L", (converged[k] - usual[k]) / weight);
        test::measured("energy lost with enough V-cycles, over m g L", (converged[k] - enough[k]) / weight);
        EXPECT_NEAR(enough[k], converged[k], 0.02 * weight) << k;
    }
}

}  // namespace
}  // namespace pliant
