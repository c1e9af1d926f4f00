// A solve of ACAD runs only over rows that a marked spring reaches (kernels/acad.kernel.glsl): nodes far from
// every constraint move as with springs alone, and nothing of one solve is left when the next begins.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "solve/frame.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

constexpr std::uint32_t rows = 64, columns = 9;
constexpr double dt = 1e-4;  // s
constexpr double activate_at = 0.1, marked_at = 0.8 * activate_at;

/// A strip without gravity, 9 nodes wide: only stretched parts move.
Scene strip(bool on_mesh, double threshold = activate_at)
{
    SurfaceMesh mesh;
    for (std::uint32_t r = 0; r < rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c)
            mesh.vertices.push_back({static_cast<float>(c) / 64, 0, static_cast<float>(r) / 64});
    test::add_cells(
        mesh, rows, columns, [](std::uint32_t r, std::uint32_t c) { return r * columns + c; },
        [](std::uint32_t r, std::uint32_t c) { return (r + c) % 2 == 1; });
    Cloth cloth = on_mesh ? Cloth::mesh(mesh, {.density = 0.3})
                          : test::flat_sheet(rows, columns, (columns - 1) / 64.0, (rows - 1) / 64.0);
    cloth.springs = {{100, 0.001}, {50, 0.001}, {1, 0}};
    Scene scene;
    scene.method = Method::acad;
    scene.gravity = {0, 0, 0};
    scene.acad.activate_at = threshold;
    scene.newton_multigrid.newton_iterations = 5;
    scene.newton_multigrid.newton_tolerance = 1e-4;
    scene.newton_multigrid.linear_iterations = 8;
    scene.newton_multigrid.linear_tolerance = 1e-3;
    scene.add(cloth);
    return scene;
}

/// The model's positions, with the strip pulled apart by 12 % of a spring's length after a row.
std::vector<Vec3> pulled_apart(const ClothModel& model, std::uint32_t row, float part = 0.12f)
{
    std::vector<Vec3> positions = model.shape.positions;
    const Vec3 a = positions[model.shape.node(0)], b = positions[model.shape.node(columns)];
    for (std::uint32_t vertex = (row + 1) * columns; vertex < positions.size(); ++vertex) {
        const std::uint32_t i = model.shape.node(vertex);
        positions[i].x += part * (b.x - a.x);
        positions[i].y += part * (b.y - a.y);
        positions[i].z += part * (b.z - a.z);
    }
    return positions;
}

struct Step {
    std::vector<float> positions, velocities;
    double active = 0;
};
/// One step from these positions, at rest.
Step step_from(PassRunner& runner, const ClothModel& model, const std::vector<Vec3>& positions)
{
    Program program{1, {}, 1};
    append_frame({&model, 1}, 1, 0, program.calls);
    runner.write(0, positions, std::vector<Vec3>(positions.size()));
    runner.run(program, {dt, 0, {}, true});
    Step step;
    runner.read(0, Resource::position, 1, step.positions);
    runner.read(0, Resource::velocity, 1, step.velocities);
    step.active = runner.solver_scalar(0, scalar_active_last);
    return step;
}

/// The rows, or groups of a mesh's nodes, in a state's solve, found spring by spring.
std::set<std::size_t> expected_rows(const ClothModel& model, const std::vector<Vec3>& positions)
{
    std::set<std::size_t> expected;
    const auto look = [&](std::size_t i, std::size_t j, double rest) {
        const Vec3 a = positions[i], b = positions[j];
        const double length = std::hypot(double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z);
        if (length < (1 + marked_at) * rest) return;
        if (model.plan.on_grid)
            for (std::size_t row = i / columns; row <= i / columns + 2; ++row) expected.insert(row);
        else
            expected.insert({i / sum_columns, j / sum_columns});
    };
    if (model.plan.on_grid)
        for_each_sheet_spring(
            *model.shape.sheet, [&](std::uint32_t i, std::uint32_t j, const SheetNeighbour& n) {
                look(i, j, model.shape.sheet->rest_lengths[static_cast<std::size_t>(n.rest)]);
            });
    else
        for (const Spring& s : model.springs.list) look(s.i, s.j, s.rest_length);
    return expected;
}

/// The rows that the solver has flagged.
std::set<std::size_t> live_rows(PassRunner& runner, const ClothModel& model)
{
    const SolverLevel& cloth = model.hierarchy.levels.front();
    const std::size_t count = cloth.rows > 1 ? static_cast<std::size_t>(cloth.rows)
                                             : (model.node_count() + sum_columns - 1) / sum_columns;
    std::vector<float> flags;
    runner.solver_numbers(0, static_cast<std::size_t>(cloth.live), count, flags);
    std::set<std::size_t> live;
    for (std::size_t k = 0; k < count; ++k)
        if (flags[k] > 0) live.insert(k);
    return live;
}

class AcadRows : public testing::TestWithParam<bool> {
protected:
    AcadRows()
        : scene(strip(GetParam())),
          idle_scene(strip(GetParam(), 10)),
          model(scene.cloth(0), scene),
          idle_model(idle_scene.cloth(0), idle_scene)
    {
    }
    std::size_t row_of(std::size_t node) const { return node / (model.plan.on_grid ? columns : sum_columns); }

    Scene scene, idle_scene;
    ClothModel model, idle_model;  ///< the second never has a constraint
};

TEST_P(AcadRows, AreThoseThatAMarkedSpringReaches)
{
    const std::vector<Vec3> start = pulled_apart(model, 20);
    const std::set<std::size_t> expected = expected_rows(model, start);
    ASSERT_LT(expected.size(), model.plan.on_grid ? 4U : 6U);  // of 64 rows, of 9 groups
    for (const Backend backend : test::backends()) {
        const auto runner = test::make_runner(backend, model);
        EXPECT_EQ(step_from(*runner, model, start).active, columns) << name_of(backend);
        EXPECT_EQ(live_rows(*runner, model), expected) << name_of(backend);
    }
}

TEST_P(AcadRows, AloneAreMoved)
{
    const std::vector<Vec3> start = pulled_apart(model, 20);
    const std::set<std::size_t> live = expected_rows(model, start);
    for (const Backend backend : test::backends()) {
        const auto runner = test::make_runner(backend, model), idle = test::make_runner(backend, idle_model);
        const Step held = step_from(*runner, model, start), loose = step_from(*idle, idle_model, start);
        EXPECT_EQ(loose.active, 0) << name_of(backend);
        std::size_t moved = 0;
        for (std::size_t i = 0; i < model.node_count(); ++i) {
            const auto at = [&](const std::vector<float>& of) {
                return Vec3{of[3 * i], of[3 * i + 1], of[3 * i + 2]};
            };
            const bool same =
                at(held.positions) == at(loose.positions) && at(held.velocities) == at(loose.velocities);
            if (live.count(row_of(i)) == 0)
                EXPECT_TRUE(same) << name_of(backend) << ", node " << i;
            else
                moved += same ? 0 : 1;
        }
        EXPECT_GE(moved, 2 * columns) << name_of(backend);  // both ends of the springs that were too long
    }
}

TEST_P(AcadRows, LeaveNothingForTheNextSolve)
{
    const std::vector<Vec3> first = pulled_apart(model, 20);
    for (const std::uint32_t row : {47U, 23U}) {  // one far away, one close enough to read leftovers
        const std::vector<Vec3> second = pulled_apart(model, row);
        Step on_cpu;
        for (const Backend backend : test::backends()) {
            const auto used = test::make_runner(backend, model), fresh = test::make_runner(backend, model);
            step_from(*used, model, first);
            const Step after = step_from(*used, model, second), alone = step_from(*fresh, model, second);
            EXPECT_EQ(after.positions, alone.positions) << name_of(backend) << ", " << row;
            EXPECT_EQ(after.velocities, alone.velocities) << name_of(backend) << ", " << row;
            EXPECT_EQ(live_rows(*used, model), expected_rows(model, second)) << name_of(backend);
            if (backend == Backend::cpu) on_cpu = after;
            if (backend == Backend::vulkan) {
                EXPECT_EQ(after.positions, on_cpu.positions);
            }
        }
    }
}

TEST_P(AcadRows, ArePartedAmongThreadsWithoutAChange)
{
    const std::vector<Vec3> first = pulled_apart(model, 20), second = pulled_apart(model, 21);
    Step one;
    for (const test::CpuWay& way : test::cpu_ways()) {
        const auto runner = make_cpu_runner({&model, 1}, way.options());
        step_from(*runner, model, first);
        const Step step = step_from(*runner, model, second);
        if (one.positions.empty()) one = step;
        EXPECT_EQ(step.positions, one.positions) << way;
    }
}

TEST_P(AcadRows, AreThoseNearTheThresholdToo)
{
    // If one spring exceeds it: the springs that the step may take there, from 8 % on.
    std::vector<Vec3> start = pulled_apart(model, 20);
    const std::vector<Vec3> less = pulled_apart(model, 40, 0.09f);
    for (std::uint32_t i = 0; i < start.size(); ++i) {
        const Vec3 a = start[i], b = less[i], c = model.shape.positions[i];
        start[i] = {a.x + (b.x - c.x), a.y + (b.y - c.y), a.z + (b.z - c.z)};
    }
    for (const Backend backend : test::backends()) {
        const auto runner = test::make_runner(backend, model);
        step_from(*runner, model, start);
        EXPECT_EQ(live_rows(*runner, model), expected_rows(model, start)) << name_of(backend);
    }
}

TEST_P(AcadRows, AreThoseAtASpringThatAPinHolds)
{
    // Row 0 is pinned, and no spring is marked but those that lead to it.
    for (std::uint32_t vertex = 0; vertex < columns; ++vertex) scene.cloth_handle(0).pin(vertex);
    const ClothModel held(scene.cloth(0), scene);
    const std::vector<Vec3> start = pulled_apart(held, 0);
    std::set<std::size_t> expected;
    if (held.plan.on_grid)
        expected = expected_rows(held, start);
    else
        for (std::uint32_t vertex = columns; vertex < 2 * columns; ++vertex)
            expected.insert(held.shape.node(vertex) / sum_columns);
    for (const Backend backend : test::backends()) {
        const auto runner = test::make_runner(backend, held);
        EXPECT_GE(step_from(*runner, held, start).active, columns) << name_of(backend);
        const std::set<std::size_t> live = live_rows(*runner, held);
        for (const std::size_t row : expected)
            EXPECT_EQ(live.count(row), 1U) << name_of(backend) << ", " << row;
        EXPECT_LE(live.size(), expected.size() + 2) << name_of(backend);  // bend springs reach the next group
    }
}

TEST_P(AcadRows, HoldOnToTheirSpringsDownToTheSecondThreshold)
{
    scene.acad.target = AcadTarget::rest;
    scene.acad.deactivate_at = 0.02;
    const ClothModel held(scene.cloth(0), scene);
    const std::vector<Vec3> first = pulled_apart(held, 20), second = pulled_apart(held, 20, 0.06f);
    for (const Backend backend : test::backends()) {
        const auto used = test::make_runner(backend, held), fresh = test::make_runner(backend, held);
        EXPECT_GE(step_from(*used, held, first).active, columns) << name_of(backend);
        EXPECT_GE(step_from(*used, held, second).active, columns) << name_of(backend);
        EXPECT_EQ(step_from(*fresh, held, second).active, 0) << name_of(backend);
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, AcadRows, testing::Bool(),
                         [](const auto& param) { return param.param ? "mesh" : "sheet"; });

}  // namespace
}  // namespace pliant
