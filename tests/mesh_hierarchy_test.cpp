// The constraint solver on meshes: the contents of its levels, and its solutions.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <random>

#include "backend/host/solver_state.hpp"
#include "body/cloth_model.hpp"
#include "body/collider_motion.hpp"
#include "kernels/planes.hpp"
#include "pliant/mesh_generators.hpp"
#include "test_cloths.hpp"
#include "test_cycles.hpp"
#include "test_differences.hpp"

namespace pliant {
namespace {

constexpr double frame = 1.0 / 60;

/// A unit square of n x n nodes, jittered, with its diagonals at random, in the x-z plane.
SurfaceMesh irregular_square(std::uint32_t n)
{
    SurfaceMesh mesh = test::irregular_mesh(n, n);
    const float scale = static_cast<float>(n) / static_cast<float>(n - 1);
    for (Vec3& x : mesh.vertices) x = {x.x * scale - 0.5f, 0, x.z * scale - 0.5f};
    return mesh;
}

std::uint32_t nearest(const SurfaceMesh& mesh, float x, float z)
{
    const auto distance = [&](const Vec3& a) { return (a.x - x) * (a.x - x) + (a.z - z) * (a.z - z); };
    const auto found =
        std::min_element(mesh.vertices.begin(), mesh.vertices.end(),
                         [&](const Vec3& a, const Vec3& b) { return distance(a) < distance(b); });
    return static_cast<std::uint32_t>(found - mesh.vertices.begin());
}

void make_inextensible(Cloth& cloth, double compliance = 1e-6)
{
    cloth.springs = {{0, 0}, {0, 0}, {1, 0}};
    cloth.springs.structural.compliance = cloth.springs.shear.compliance = compliance;
    cloth.damping = 0;
}

Scene hanging(const SurfaceMesh& mesh, double compliance = 1e-6)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.time.substeps = 1;
    Cloth cloth = Cloth::mesh(mesh, {.density = 0.3});
    make_inextensible(cloth, compliance);
    cloth.pin(nearest(mesh, -0.5f, -0.5f));
    cloth.pin(nearest(mesh, 0.5f, -0.5f));
    scene.add(cloth);
    return scene;
}

/// Two tiles, one of them pinned, and a triangle, none of which touch.
SurfaceMesh three_pieces()
{
    SurfaceMesh mesh = test::irregular_mesh(6, 6);
    const SurfaceMesh other = test::irregular_mesh(5, 9, 3);
    const auto append = [&](const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                            float shift) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const Vec3& x : vertices) mesh.vertices.push_back({x.x + shift, x.y, x.z});
        for (const Triangle& t : triangles)
            mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    };
    append(other.vertices, other.triangles, 5);
    append({{0, 0, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}}, {{0, 1, 2}}, 9);
    return mesh;
}

using Rows = std::vector<std::map<std::int32_t, double>>;

/// By fine node, with the weights of coarse nodes.
Rows parents(const Hierarchy& hierarchy, std::size_t coarse)
{
    const SolverLevel &level = hierarchy.levels[coarse], &finer = hierarchy.levels[coarse - 1];
    const auto at = [&](std::int32_t k) { return hierarchy.topology[static_cast<std::size_t>(k)]; };
    Rows rows(static_cast<std::size_t>(finer.columns));
    for (std::int32_t i = 0; i < finer.columns; ++i)
        for (std::int32_t k = at(level.parents_start + i); k < at(level.parents_start + i + 1); k += 2)
            rows[static_cast<std::size_t>(i)][at(k) - Hierarchy::offset(level, 0, 0)] =
                static_cast<double>(std::bit_cast<float>(at(k + 1)));
    return rows;
}

TEST(MeshHierarchy, TakesAllOfACoarseNodeWhereThingsAreCoupled)
{
    Scene scene = hanging(three_pieces());
    const ClothModel model(scene.cloth(0), scene);
    const Hierarchy& hierarchy = model.hierarchy;
    ASSERT_GE(hierarchy.level_count(), 2u);
    for (std::size_t k = 1; k < hierarchy.level_count(); ++k) {
        const SolverLevel& finer = hierarchy.levels[k - 1];
        const Rows rows = parents(hierarchy, k);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const auto start = static_cast<std::size_t>(finer.row_start) + i;
            const bool is_coupled = hierarchy.topology[start] < hierarchy.topology[start + 1];
            double sum = 0;
            for (const auto& [coarse, weight] : rows[i]) {
                EXPECT_GE(coarse, 0);
                EXPECT_LT(coarse, hierarchy.levels[k].columns);
                sum += weight;
            }
            EXPECT_NEAR(sum, is_coupled ? 1 : 0, 1e-6) << "level " << k << ", node " << i;
        }
        EXPECT_LE(2 * hierarchy.levels[k].columns, finer.columns);
    }
    EXPECT_LE(hierarchy.levels.back().columns, 12);
}

/// The operator of a level, dense, from its couplings and row sums.
std::vector<double> operator_of(const Hierarchy& hierarchy, std::size_t k, std::span<const double> arena)
{
    const SolverLevel& level = hierarchy.levels[k];
    const auto n = static_cast<std::size_t>(3 * level.columns);
    std::vector<double> a(n * n, 0.0);
    const auto add = [&](std::int32_t i, std::int32_t j, std::int32_t block, double sign) {
        constexpr std::size_t place[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 3; ++c)
                a[(static_cast<std::size_t>(3 * i) + r) * n + static_cast<std::size_t>(3 * j) + c] +=
                    sign * arena[static_cast<std::size_t>(level.edge_base + 6 * block) + place[r][c]];
    };
    for (std::int32_t i = 0; i < level.columns; ++i) add(i, i, level.edges + i, 1);
    const std::int32_t first = Hierarchy::offset(level, 0, 0);
    const auto node = [&](std::int32_t place) {
        return hierarchy.topology[static_cast<std::size_t>(place)] - first;
    };
    std::vector<bool> is_held(static_cast<std::size_t>(level.edges), true);
    for (std::int32_t k2 = 0; k2 < level.columns; ++k2) {
        const auto start = static_cast<std::size_t>(level.row_start + k2);
        for (std::int32_t p = hierarchy.topology[start]; p < hierarchy.topology[start + 1]; p += 2)
            is_held[static_cast<std::size_t>(hierarchy.topology[static_cast<std::size_t>(p) + 1])] = false;
    }
    for (std::int32_t e = 0; e < level.edges; ++e) {
        if (is_held[static_cast<std::size_t>(e)]) continue;  // its block is in the row sum
        const std::int32_t i = node(level.edge_ends + 3 * e), j = node(level.edge_ends + 3 * e + 1);
        add(i, i, e, 1);
        add(j, j, e, 1);
        add(i, j, e, -1);
        add(j, i, e, -1);
    }
    return a;
}

TEST(MeshHierarchy, CoarseOperatorsAreWhatProlongationMakesOfFineOnes)
{
    Scene scene = hanging(test::irregular_mesh(15, 17));
    scene.newton_multigrid.resists = Resists::both;
    scene.add(Sphere{.centre = {0.4, -0.1, 0.4}, .radius = 0.12});
    ClothModel model(scene.cloth(0), scene);
    std::mt19937 engine(5);
    std::uniform_real_distribution<float> shake(-0.01f, 0.01f);
    for (Vec3& x : model.shape.positions) x = {x.x + shake(engine), x.y + shake(engine), x.z + shake(engine)};

    PlainCloth<double> cloth(model);
    SolverState<double> solver(model, model.hierarchy);
    const auto constants = make_solver_constants<double>(model, frame);
    const std::vector<Laws<double>::Collider> colliders{
        make_collider<double>(placed_at(scene.colliders.front(), 0))};
    const auto run = [&](Pass pass, std::uint32_t level) {
        Call call{pass};
        call.level = level;
        solver.run(call, solver.context(call, cloth, constants, colliders), 0, solver.size_of(call));
    };
    run(Pass::step_begin, 0);
    run(Pass::mesh_springs, 0);
    run(Pass::mesh_fold, 0);
    run(Pass::mesh_gather, 0);
    const Hierarchy& hierarchy = model.hierarchy;
    ASSERT_GE(hierarchy.level_count(), 3u);
    for (std::uint32_t k = 1; k < hierarchy.level_count(); ++k) {
        run(Pass::mesh_coarsen_couplings, k);
        run(Pass::mesh_coarsen_nodes, k);
        const std::vector<double> fine = operator_of(hierarchy, k - 1, solver.arena());
        const std::vector<double> coarse = operator_of(hierarchy, k, solver.arena());
        const Rows rows = parents(hierarchy, k);
        const std::size_t n = 3 * rows.size(), m = static_cast<std::size_t>(3 * hierarchy.levels[k].columns);
        test::Largest largest;
        for (const double a : coarse) largest.add(std::abs(a));
        ASSERT_GT(largest.value(), 0);
        std::vector<double> expected(m * m, 0.0);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                for (const auto& [coarse_i, weight_i] : rows[i / 3])
                    for (const auto& [coarse_j, weight_j] : rows[j / 3])
                        expected[(static_cast<std::size_t>(3 * coarse_i) + i % 3) * m +
                                 static_cast<std::size_t>(3 * coarse_j) + j % 3] +=
                            weight_i * weight_j * fine[i * n + j];
        // Weights are floats, and sum up to 1 to rounding.
        for (std::size_t e = 0; e < m * m; ++e)
            ASSERT_NEAR(coarse[e], expected[e], 1e-5 * largest.value()) << "level " << k;
    }
}

TEST(MeshHierarchy, CyclesDoNotGrowWithTheMesh)
{
    for (const std::uint32_t n : {25u, 50u, 100u})
        for (const double compliance : {1e-7, 1e-6, 1e-4}) {
            // One Newton iteration leaves wrinkles, which make later systems harder.
            test::expect_few_cycles(
                hanging(irregular_square(n), compliance), {25, 25, 40},
                (testing::Message() << n << " x " << n << " nodes, compliance " << compliance).GetString());
        }
}

TEST(MeshHierarchy, ThreadsChangeNothing)
{
    Scene scene = hanging(irregular_square(50));
    scene.add(Sphere{.centre = {0, -0.3, 0.1}, .radius = 0.2, .friction = 0.3});
    std::uint64_t expected = 0;
    for (const unsigned threads : {1u, 2u, 3u}) {
        SimulationOptions options = test::on(Backend::cpu);
        options.threads = threads;
        Simulation simulation(scene, options);
        for (int k = 0; k < 20; ++k) simulation.advance(frame);
        EXPECT_TRUE(simulation.report().finite);
        if (threads == 1) expected = simulation.state_hash();
        EXPECT_EQ(simulation.state_hash(), expected) << threads << " threads";
    }
}

TEST(MeshHierarchy, CpuFollowsTheReference)
{
    Scene scene = hanging(irregular_square(15), 1e-4);
    scene.newton_multigrid.newton_iterations = 30;
    scene.newton_multigrid.newton_tolerance = 1e-4;
    scene.newton_multigrid.linear_iterations = 30;
    scene.newton_multigrid.linear_tolerance = 1e-2;
    scene.newton_multigrid.resists = Resists::both;
    Simulation cpu(scene, test::on(Backend::cpu)), reference(scene, test::on(Backend::reference));
    for (int k = 0; k < 4; ++k) {
        cpu.advance(frame);
        reference.advance(frame);
        EXPECT_LE(test::largest_difference(cpu.positions(), reference.positions()), 3e-4);
    }
    EXPECT_GT(reference.report().measures.max_speed, 0.1);
}

Scene hung_disc(std::uint32_t rings)
{
    const std::uint32_t hem = 1 + 3 * rings * (rings - 1);
    Scene scene;
    scene.method = Method::constraint;
    Cloth cloth = Cloth::disc({.radius = 0.5, .rings = rings, .density = 0.3});
    make_inextensible(cloth);
    cloth.pin(hem + 3 * rings / 4).pin(hem + 9 * rings / 4);
    scene.add(std::move(cloth));
    return scene;
}
Scene hung_shirt(std::uint32_t squares)
{
    const ShirtOptions shirt{.squares = squares};
    const SurfaceMesh mesh = shirt_mesh(shirt);
    const auto shoulder = [&](double side) {
        const auto distance = [&](const Vec3& a) {
            const double x = a.x - side * shirt.width / 4, y = a.y - 0.65 * shirt.width;
            return x * x + y * y + double{a.z} * a.z;
        };
        return static_cast<std::uint32_t>(
            std::min_element(mesh.vertices.begin(), mesh.vertices.end(),
                             [&](const Vec3& a, const Vec3& b) { return distance(a) < distance(b); }) -
            mesh.vertices.begin());
    };
    Scene scene;
    scene.method = Method::constraint;
    Cloth cloth = Cloth::mesh(mesh, {.density = 0.3});
    make_inextensible(cloth);
    cloth.rotation = {-90, 0, 0};
    cloth.pin(shoulder(-1)).pin(shoulder(1));
    scene.add(std::move(cloth));
    return scene;
}

// After half a second, positions match those of completely solved steps in root mean square. At these sizes
// this is not chaotic: moved by 1e-6 m, nodes of a solved run differ by 0.01 cm. If slack springs kept all
// their stiffness in Newton's matrix, the disc would be off by 4 cm, the T-shirt by 8 cm.
TEST(MeshHierarchy, FallsAsStepsThatAreSolvedToTheEnd)
{
    const struct {
        Scene scene;
        double most;  // m
    } cases[] = {{hung_disc(14), 0.025}, {hung_shirt(1), 0.055}};
    for (const auto& c : cases) {
        Scene solved = c.scene;
        solved.newton_multigrid.newton_iterations = 40;
        solved.newton_multigrid.newton_tolerance = 0.01;
        solved.newton_multigrid.linear_iterations = 30;
        solved.newton_multigrid.linear_tolerance = 0.03;
        Simulation fast(c.scene, test::on(Backend::cpu)), exact(solved, test::on(Backend::cpu));
        for (int k = 0; k < 30; ++k) fast.advance(frame), exact.advance(frame);
        const auto x = fast.positions(), y = exact.positions();
        double squares = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Vec3d d = to_double(x[i]) - to_double(y[i]);
            squares += dot(d, d);
        }
        EXPECT_LE(std::sqrt(squares / static_cast<double>(x.size())), c.most) << x.size() << " nodes";
        EXPECT_GT(exact.report().measures.max_speed, 0.5);
    }
}

TEST(MeshHierarchy, HangsAndSwingsLikeASheet)
{
    const std::uint32_t n = 33;
    const SurfaceMesh square = irregular_square(n);
    Scene of_mesh = hanging(square), of_sheet = hanging(square);
    Cloth& sheet = *of_sheet.cloth_handle(0);
    sheet = test::flat_sheet(n, n);
    make_inextensible(sheet);
    sheet.pin(Corner::top_left).pin(Corner::top_right);
    for (Scene* scene : {&of_mesh, &of_sheet}) {
        scene->newton_multigrid.newton_iterations = 12;
        scene->newton_multigrid.linear_iterations = 16;
    }
    Simulation mesh_run(of_mesh, test::on(Backend::cpu)), sheet_run(of_sheet, test::on(Backend::cpu));
    const std::uint32_t middle = nearest(square, 0, 0.5f);
    test::Largest stretch;
    for (int k = 1; k <= 30; ++k) {
        mesh_run.advance(frame);
        sheet_run.advance(frame);
        stretch.add(mesh_run.report().measures.max_stretch);
        const double height = mesh_run.positions()[middle].y;
        const double expected = sheet_run.positions()[(n - 1) * n + n / 2].y;
        if (k % 15 != 0) continue;
        EXPECT_LT(expected, -0.2) << "frame " << k;
        EXPECT_NEAR(height, expected, 0.06) << "frame " << k;
    }
    EXPECT_LE(stretch.value(), 0.01);
}

TEST(MeshHierarchy, PiecesOnTheirOwnFallFreely)
{
    const SurfaceMesh mesh = three_pieces();
    Scene scene = hanging(mesh);
    scene.newton_multigrid.newton_iterations = 30;
    scene.newton_multigrid.newton_tolerance = 1e-5;
    scene.newton_multigrid.linear_iterations = 30;
    scene.newton_multigrid.linear_tolerance = 1e-3;
    Simulation simulation(scene, test::on(Backend::cpu));
    const int frames = 20;
    for (int k = 0; k < frames; ++k) simulation.advance(frame);
    const double fallen = -0.5 * 9.81 * frame * frame * frames * (frames + 1);
    const auto x = simulation.positions();
    for (std::size_t i = 36; i < mesh.vertices.size(); ++i)
        EXPECT_NEAR(x[i].y - mesh.vertices[i].y, fallen, 2e-4) << "node " << i;
    EXPECT_LE(simulation.report().measures.max_stretch, 0.01);
}

TEST(MeshHierarchy, AMeshThatIsPinnedEverywhereStaysWhereItIs)
{
    SurfaceMesh mesh = test::irregular_mesh(4, 5);
    Scene scene = hanging(mesh);
    scene.cloth_handle(0).pin(Region{{-10, -10, -10}, {10, 10, 10}});
    Simulation simulation(scene, test::on(Backend::cpu));
    for (int k = 0; k < 3; ++k) simulation.advance(frame);
    EXPECT_TRUE(simulation.report().finite);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        EXPECT_EQ(simulation.positions()[i].y, mesh.vertices[i].y);
}

}  // namespace
}  // namespace pliant
