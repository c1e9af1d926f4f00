// The passes of the constraint solver on every backend, with odd sizes, one step at a time: cpu with each
// instruction set and several threads and vulkan agree bit by bit, and match the reference up to rounding and
// the tolerance of steps.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "backend/pass_runner.hpp"
#include "backend/vulkan/vulkan_runner.hpp"
#include "solve/frame.hpp"
#include "solve/newton_multigrid.hpp"
#include "test_differences.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

struct SolverCase {
    const char* name;
    std::uint32_t rows = 2, columns = 2;
    bool mesh = false;
    Method method = Method::constraint;
    Solver solver = Solver::newton_multigrid;
    Preconditioner preconditioner = Preconditioner::multigrid;
    std::uint32_t smoothing = 1;
    bool stiff_bend = false;
    bool graded = false;       ///< springs have numbers of their own
    std::uint32_t rings = 0;   ///< a disc
    std::uint32_t spokes = 0;  ///< a wheel
    std::uint32_t order = 1;   ///< in time
    bool wind = false;
};
void PrintTo(const SolverCase& c, std::ostream* out) { *out << c.name; }

const SolverCase cases[] = {
    {.name = "sheet_2x2", .rows = 2, .columns = 2},
    {.name = "sheet_2x9", .rows = 2, .columns = 9},
    {.name = "sheet_3x31", .rows = 3, .columns = 31},
    {.name = "sheet_17x16", .rows = 17, .columns = 16, .smoothing = 2},
    {.name = "sheet_31x33", .rows = 31, .columns = 33},
    {.name = "sheet_3x65", .rows = 3, .columns = 65},
    {.name = "sheet_130x2", .rows = 130, .columns = 2, .smoothing = 3},
    {.name = "sheet_4x150", .rows = 4, .columns = 150},
    {.name = "sheet_5x300", .rows = 5, .columns = 300},  // the CPU takes 256 columns at a time
    {.name = "sheet_4x1030", .rows = 4, .columns = 1030},
    {.name = "sheet_stiff_bend", .rows = 9, .columns = 21, .smoothing = 3, .stiff_bend = true},
    {.name = "sheet_much_smoothing", .rows = 9, .columns = 13, .smoothing = 6},
    {.name = "sheet_jacobi", .rows = 9, .columns = 7, .preconditioner = Preconditioner::jacobi},
    {.name = "sheet_plain", .rows = 9, .columns = 7, .preconditioner = Preconditioner::none},
    {.name = "mesh_2x2", .rows = 2, .columns = 2, .mesh = true},
    {.name = "mesh_17x13", .rows = 17, .columns = 13, .mesh = true},
    // Packs: of full ones with another at the end, of lanes with as many neighbours and with far from as
    // many.
    {.name = "mesh_5x13", .rows = 5, .columns = 13, .mesh = true, .smoothing = 2},
    {.name = "mesh_8x8", .rows = 8, .columns = 8, .mesh = true},
    {.name = "disc_of_127", .smoothing = 3, .rings = 6},
    {.name = "wheel_of_46", .spokes = 45},
    {.name = "acad_wheel", .method = Method::acad, .spokes = 70},
    {.name = "graded_sheet", .rows = 9, .columns = 13, .smoothing = 2, .graded = true},
    {.name = "graded_mesh", .rows = 9, .columns = 13, .mesh = true, .graded = true},
    {.name = "sheet_second_order", .rows = 17, .columns = 35, .order = 2},
    {.name = "bent_second_order", .rows = 9, .columns = 21, .stiff_bend = true, .order = 2},
    {.name = "mesh_second_order", .rows = 17, .columns = 13, .mesh = true, .order = 2},
    {.name = "wind_second_order", .rows = 9, .columns = 21, .order = 2, .wind = true},
    {.name = "acad_graded", .rows = 9, .columns = 11, .method = Method::acad, .graded = true},
    {.name = "acad_sheet", .rows = 9, .columns = 11, .method = Method::acad},
    {.name = "acad_mesh", .rows = 9, .columns = 11, .mesh = true, .method = Method::acad},
    {.name = "paper_sheet", .rows = 7, .columns = 9, .solver = Solver::paper},
    {.name = "paper_mesh", .rows = 5, .columns = 7, .mesh = true, .solver = Solver::paper},
    {.name = "paper_acad", .rows = 7, .columns = 9, .method = Method::acad, .solver = Solver::paper},
};

constexpr double dt = 1e-3;  // s
constexpr int steps = 2;

/// A node with as many neighbours as there are others, which have three each; bending aside.
SurfaceMesh wheel(std::uint32_t spokes)
{
    SurfaceMesh mesh;
    for (std::uint32_t k = 0; k < spokes; ++k) {
        const float angle = 6.2831853f * static_cast<float>(k) / static_cast<float>(spokes);
        mesh.vertices.push_back(
            {0.5f * std::cos(angle), 0.01f * std::cos(3 * angle), 0.5f * std::sin(angle)});
        mesh.triangles.push_back({k, (k + 1) % spokes, spokes});
    }
    mesh.vertices.push_back({});
    return mesh;
}

Cloth cloth_of(const SolverCase& c)
{
    if (c.rings > 0) return Cloth::disc({.radius = 0.5, .rings = c.rings, .density = 0.3});
    if (c.spokes > 0) return Cloth::mesh(wheel(c.spokes), {.density = 0.3});
    if (c.mesh) return Cloth::mesh(test::irregular_mesh(c.rows, c.columns), {.density = 0.3});
    return test::flat_sheet(c.rows, c.columns, 1.0, 0.8);
}

Scene scene_of(const SolverCase& c)
{
    Scene scene;
    scene.method = c.method;
    scene.solver = c.solver;
    scene.newton_multigrid.preconditioner = c.preconditioner;
    scene.newton_multigrid.smoothing = c.smoothing;
    scene.newton_multigrid.order = c.order;
    scene.newton_multigrid.linear_iterations = c.preconditioner == Preconditioner::multigrid ? 10 : 40;
    scene.newton_multigrid.linear_tolerance = 1e-4;
    scene.newton_multigrid.newton_tolerance = 1e-5;
    scene.newton_multigrid.newton_iterations = 40;
    // Both directions, to rest length: one-sided limits are switched by rounding where they hardly pull.
    // Their physics is tested in constraint_test.cpp and paper_solver_test.cpp.
    scene.newton_multigrid.resists = Resists::both;
    if (c.solver == Solver::paper) scene.acad.target = AcadTarget::rest;
    scene.paper.tolerance = 1e-6;
    scene.paper.max_iterations = 500;
    if (c.wind) scene.air = {.velocity = {1, 3, 2}, .density = 1.2};
    Cloth cloth = cloth_of(c);
    cloth.springs = {{1000, 0.01}, {500, 0.01}, {1, 0}};
    cloth.springs.structural.compliance = cloth.springs.shear.compliance = cloth.springs.bend.compliance =
        1e-4;
    if (c.stiff_bend) cloth.springs.bend.role = SpringRole::constraint;
    if (c.graded) {
        cloth.springs.bend_model = BendModel::quadratic;
        if (auto* sheet = std::get_if<SheetOptions>(&cloth.shape)) sheet->border = SheetBorder::half;
    }
    cloth.pin(std::uint32_t{0});
    scene.add(cloth);
    scene.add(Sphere{.centre = {0.1, -0.2, 0.1}, .radius = 0.1985, .friction = 0.3});
    return scene;
}

std::vector<Call> frame_of(const ClothModel& model, std::uint32_t parity)
{
    std::vector<Call> calls;
    append_frame({&model, 1}, 1, parity, calls);
    append_multipliers(model, 0, 1 - parity, calls);
    return calls;
}

/// Stretched at first, so that constraints and ACAD have work to do.
ClothModel stretched_model(const Scene& scene)
{
    ClothModel model(scene.cloth(0), scene);
    const float factor = scene.method == Method::acad ? 1.12f : 1.002f;
    for (Vec3& x : model.shape.positions) x = {factor * x.x, x.y, x.z};
    return model;
}

struct State {
    std::vector<float> position, multiplier;
};
State state_after(PassRunner& runner, const ClothModel& model, const Scene& scene)
{
    std::vector<PlacedCollider> colliders;
    for (const Collider& collider : scene.colliders) colliders.push_back(placed_at(collider, 0));
    std::uint32_t parity = 0;
    for (int step = 0; step < steps; ++step, parity ^= 1)
        runner.run({std::uint64_t{1} + parity, frame_of(model, parity), 1 - parity},
                   {dt, static_cast<std::uint32_t>(colliders.size()), colliders, true});
    State state;
    runner.read(0, Resource::position, parity, state.position);
    runner.read(0, Resource::multiplier, parity, state.multiplier);
    return state;
}

std::vector<float> positions_of(const ClothModel& model)
{
    std::vector<float> positions;
    for (const Vec3& x : model.shape.positions) positions.insert(positions.end(), {x.x, x.y, x.z});
    return positions;
}

/// The same bits, and finite.
template <class Who>
void expect_same(const State& state, const State& first, const Who& who)
{
    EXPECT_EQ(test::bit_differences(state.position, first.position).count, 0u) << who;
    EXPECT_EQ(test::bit_differences(state.multiplier, first.multiplier).count, 0u) << who;
}

class SolverParity : public testing::TestWithParam<SolverCase> {};

TEST_P(SolverParity, FollowsTheReference)
{
    const Scene scene = scene_of(GetParam());
    const ClothModel model = stretched_model(scene);
    const State exact = state_after(*make_reference_runner({&model, 1}), model, scene);
    const test::CpuWay way = test::cpu_ways().back();
    const State state = state_after(*make_cpu_runner({&model, 1}, way.options()), model, scene);
    // Steps are solved to 1e-5 of their load. Two steps move nodes by up to some millimetres, and ACAD, which
    // lets go a sheet that is 12 % too long, by some centimetres: what is left of them is under 1e-4 of that.
    const double tolerance = GetParam().method == Method::acad ? 1e-5 : 1e-6;
    EXPECT_LE(test::largest_difference(state.position, exact.position), tolerance) << way;
    test::Largest multiplier;
    for (const float m : exact.multiplier) multiplier.add(double{m});
    EXPECT_GT(multiplier.value(), 0.01);  // N: constraints have acted
    EXPECT_LE(test::largest_difference(state.multiplier, exact.multiplier), 0.02 * multiplier.value() + 1e-3);
    // A step that every backend skips would also make all of them agree.
    EXPECT_GT(test::largest_difference(exact.position, positions_of(model)), 1e-5);
}

TEST_P(SolverParity, AllBackendsAgree)
{
    // A few of Newton's iterations: all of them take minutes on a driver without a GPU, and golden_test.cpp
    // compares whole steps.
    Scene scene = scene_of(GetParam());
    if (!test::wants_every_way()) scene.newton_multigrid.newton_iterations = 3;
    const ClothModel model = stretched_model(scene);
    State first;  // the others have its bits
    for (const test::CpuWay& way : test::cpu_ways()) {
        const State state = state_after(*make_cpu_runner({&model, 1}, way.options()), model, scene);
        if (first.position.empty()) first = state;
        expect_same(state, first, testing::PrintToString(way));
    }
    EXPECT_GT(test::largest_difference(first.position, positions_of(model)), 1e-5);
    if (test::has_vulkan) {
        const auto vulkan = make_vulkan_runner({&model, 1}, test::on(Backend::vulkan));
        expect_same(state_after(*vulkan, model, scene), first, "vulkan");
        EXPECT_EQ(vulkan->validation_messages(), 0U);
    }
}

INSTANTIATE_TEST_SUITE_P(Cases, SolverParity, testing::ValuesIn(cases),
                         [](const auto& param) { return std::string(param.param.name); });

TEST(SolverPassTable, EveryPassIsRunByTheCasesAbove)
{
    std::set<Pass> run;
    for (const SolverCase& c : cases) {
        const Scene scene = scene_of(c);
        const ClothModel model(scene.cloth(0), scene);
        for (const Call& call : frame_of(model, 0)) run.insert(call.pass);
    }
    for (std::size_t p = 0; p < all_passes().size(); ++p)
        if (is_solver_pass(static_cast<Pass>(p))) {
            EXPECT_EQ(run.count(static_cast<Pass>(p)), 1U) << all_passes()[p].name;
        }
}

}  // namespace
}  // namespace pliant
