// Springs held by constraints: compared with a hanging strip whose tensions are known, and between all
// backends.
#include <gtest/gtest.h>

#include <numeric>

#include "pliant/simulation.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

constexpr std::uint32_t rows = 11, columns = 2;
constexpr double threshold = 0.02, edge = 0.1;  // m

/// A strip of 1 kg that hangs from its first row. Below row r hang 10 - r nodes of each column, so its
/// vertical springs bear T_r = (10 - r) g / 22; without a constraint they are longer by T_r / k. With this k
/// the threshold is between T_4 and T_5.
Scene hanging_strip(Method method, Solver solver)
{
    Scene scene;
    scene.method = method;
    scene.solver = solver;
    scene.acad.activate_at = threshold;
    auto strip = scene.add(
        Cloth::sheet({.rows = rows, .columns = columns, .width = edge, .height = 1, .density = 1 / edge}));
    const double k = 5.5 * 9.81 / 22 / (threshold * edge);
    strip->springs.structural = {k, 1};
    strip->springs.shear = {0, 0};
    strip->springs.bend = {0, 0};
    strip->springs.structural.limit = strip->springs.shear.limit = 0;
    strip->damping = 8;  // 1/s
    for (std::uint32_t node = 0; node < columns; ++node) strip->pin(node);
    strip->rotation = {90, 0, 0};
    scene.time.substeps = 5;  // 3.3 ms, and 4.3 ms are stable
    return scene;
}

std::vector<std::uint32_t> held_after(const Scene& scene, Backend backend, int frames, std::uint64_t& active)
{
    Simulation simulation(scene, {.backend = backend, .threads = 1});
    for (int k = 0; k < frames; ++k) simulation.advance(1.0 / 60);
    EXPECT_TRUE(simulation.report().finite);
    active = simulation.report().solver.active_last;
    const auto held = simulation.held_springs();
    EXPECT_EQ(held.size(), simulation.springs().size());
    return {held.begin(), held.end()};
}

/// By row, of the vertical springs of the first column.
std::vector<std::uint32_t> vertical(const Scene& scene, const std::vector<std::uint32_t>& held)
{
    std::vector<std::uint32_t> of(rows - 1, 9);
    const auto springs = Simulation(scene, {.backend = Backend::reference}).springs();
    for (std::size_t s = 0; s < springs.size(); ++s)
        if (springs[s].i % columns == 0 && springs[s].j == springs[s].i + columns)
            of[springs[s].i / columns] = held[s];
    return of;
}

TEST(HeldSprings, AreTheRowsOfThePapersSystem)
{
    const Scene scene = hanging_strip(Method::acad, Solver::paper);
    for (const int frames : {4, 6, 9, 14}) {
        std::uint64_t active = 0;
        const auto held = held_after(scene, Backend::cpu, frames, active);
        EXPECT_EQ(std::accumulate(held.begin(), held.end(), std::uint64_t{0}), active) << frames;
        if (frames >= 6) {
            EXPECT_GT(active, 0u) << frames;
        }
    }
}

TEST(HeldSprings, AreAllThatCarryWithTheMethodConstraint)
{
    const Scene scene = hanging_strip(Method::constraint, Solver::newton_multigrid);
    std::uint64_t active = 0;
    const auto held = held_after(scene, Backend::cpu, 120, active);
    EXPECT_EQ(vertical(scene, held), std::vector<std::uint32_t>(rows - 1, 1));
}

TEST(HeldSprings, AreThoseBeyondTheThresholdWhereStepsAreTooLongForSpringsAlone)
{
    Scene scene = hanging_strip(Method::acad, Solver::newton_multigrid);
    scene.time.substeps = 1;
    scene.newton_multigrid = {.newton_iterations = 20,  // at rest, not on the way there
                              .newton_tolerance = 1e-4,
                              .linear_iterations = 40,
                              .linear_tolerance = 1e-4};
    std::uint64_t active = 0;
    const auto held = held_after(scene, Backend::cpu, 120, active);
    EXPECT_EQ(vertical(scene, held), (std::vector<std::uint32_t>{1, 1, 1, 1, 1, 0, 0, 0, 0, 0}));
}

TEST(HeldSprings, AreTheSameOnAllBackends)
{
    for (const Solver solver : {Solver::newton_multigrid, Solver::paper}) {
        Scene scene = hanging_strip(Method::acad, solver);
        scene.newton_multigrid.newton_iterations = 2;
        scene.newton_multigrid.linear_iterations = 8;
        std::uint64_t active = 0;
        const auto held = held_after(scene, Backend::cpu, 6, active);
        EXPECT_GT(active, 0u);
        if (!vulkan::list_physical_devices().empty()) {
            EXPECT_EQ(held_after(scene, Backend::vulkan, 6, active), held) << name_of(solver);
        }
    }
}

/// Without weight, in steps that are short enough for springs alone, and held at the lengths at rest as soon
/// as one spring is beyond the threshold.
Scene weightless(Cloth cloth)
{
    cloth.springs = {{100, 0.001}, {50, 0.001}, {1, 0}};
    Scene scene;
    scene.method = Method::acad;
    scene.solver = Solver::newton_multigrid;
    scene.acad.activate_at = threshold;
    scene.acad.target = AcadTarget::rest;
    scene.gravity = {};
    scene.time.substeps = 20;
    scene.add(std::move(cloth));
    return scene;
}

TEST(HeldSprings, AreNoneInAStepThatHasNothingToSolve)
{
    for (const bool mesh : {false, true})
        for (const Backend backend : {Backend::reference, Backend::cpu}) {
            const std::string what = std::string(mesh ? "mesh, " : "sheet, ") + name_of(backend);
            Simulation simulation(weightless(mesh ? Cloth::mesh(test::irregular_mesh(9, 7), {.density = 0.3})
                                                  : test::flat_sheet(9, 7)),
                                  test::on(backend));
            const State start = simulation.state();
            const auto held_of = [&](float stretch) {
                State state = start;
                for (Vec3& x : state.cloths[0].positions)
                    x = {x.x * (1 + stretch), x.y * (1 + stretch), x.z * (1 + stretch)};
                simulation.set_state(state);
                simulation.advance(1 / 1200.0);  // one step
                const auto held = simulation.held_springs();
                return std::accumulate(held.begin(), held.end(), 0u);
            };
            EXPECT_GT(held_of(0.05f), 0u) << what;
            EXPECT_GT(simulation.report().solver.active_last, 0u) << what;
            EXPECT_EQ(held_of(0.01f), 0u) << what;
            EXPECT_EQ(simulation.report().solver.active_last, 0u) << what;
        }
}

TEST(HeldSprings, AreNoneWithoutConstraints)
{
    std::uint64_t active = 0;
    const Scene scene = hanging_strip(Method::mass_spring, Solver::newton_multigrid);
    Simulation simulation(scene, {.backend = Backend::cpu, .threads = 1});
    simulation.advance(1.0 / 60);
    EXPECT_TRUE(simulation.held_springs().empty());
    EXPECT_EQ(simulation.report().solver.active_last, active);
}

}  // namespace
}  // namespace pliant
