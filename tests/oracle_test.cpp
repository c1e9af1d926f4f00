// The implicit step compared with an independent oracle (oracle/implicit_step.hpp): forces, energies, the
// operator's diagonal and couplings in the arena, its product with a vector, and the end of a step. Small
// cloths with all features of a step.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "backend/cpu/kernels.hpp"
#include "backend/vulkan/vulkan_runner.hpp"
#include "oracle/implicit_step.hpp"
#include "oracle/solver_arena.hpp"
#include "solve/mass_spring.hpp"
#include "solve/newton_multigrid.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

using oracle::Block;
using oracle::ImplicitStep;
using oracle::Kind;
using oracle::Matrix;
using oracle::Point;
using oracle::SolverArena;
using oracle::Vector;

constexpr double dt = 1.0 / 120;           // s
constexpr double rounding = 0x1p-24;       // relative, of a float
constexpr double stiffest = 1e4;           // N/m, of springs and constraints
constexpr double contact_stiffness = 2e4;  // N/m

struct OracleCase {
    const char* name;
    bool disc = false;            ///< of 37 nodes; else a sheet of 5 x 4
    bool quadratic = false;       ///< bending, and of a sheet the border half
    bool implicit_euler = false;  ///< springs alone
    SpringRole bend = SpringRole::spring;
    Resists resists = Resists::tension;
    double limit = 0;
    double damping = 0;  ///< N s/m
    bool contact = false;
    double slippery = 1;  ///< of friction
    bool remembers = false;
    bool second_order = false;  ///< in time, after a step
};
void PrintTo(const OracleCase& c, std::ostream* out) { *out << c.name; }

const OracleCase cases[] = {
    {.name = "sheet"},
    {.name = "sheet_both", .resists = Resists::both},
    {.name = "sheet_limits", .limit = 0.02},
    {.name = "sheet_limits_both", .resists = Resists::both, .limit = 0.02},
    {.name = "sheet_stiff_bend", .bend = SpringRole::constraint, .damping = 0.3},
    {.name = "sheet_springs", .implicit_euler = true, .damping = 0.5},
    {.name = "sheet_contact", .damping = 0.2, .contact = true},
    {.name = "sheet_slides", .damping = 0.2, .contact = true, .slippery = 0.002},
    {.name = "sheet_quadratic", .quadratic = true, .damping = 0.2, .contact = true},
    {.name = "sheet_remembers", .limit = 0.02, .contact = true, .remembers = true},
    {.name = "sheet_second_order", .resists = Resists::both, .damping = 0.4, .second_order = true},
    {.name = "sheet_bend_second_order", .bend = SpringRole::constraint, .damping = 0.3, .second_order = true},
    {.name = "sheet_springs_second_order", .implicit_euler = true, .damping = 0.5, .second_order = true},
    {.name = "sheet_remembers_second_order", .limit = 0.02, .remembers = true, .second_order = true},
    {.name = "disc_second_order", .disc = true, .damping = 0.3, .second_order = true},
    {.name = "disc_remembers", .disc = true, .resists = Resists::both, .remembers = true},
    {.name = "disc", .disc = true},
    {.name = "disc_both", .disc = true, .resists = Resists::both, .damping = 0.3},
    {.name = "disc_limits", .disc = true, .limit = 0.02},
    {.name = "disc_springs", .disc = true, .implicit_euler = true},
    {.name = "disc_contact", .disc = true, .damping = 0.2, .contact = true},
    {.name = "disc_quadratic", .disc = true, .quadratic = true, .contact = true},
};

/// `taut`: pinned along its border, with more nodes.
Scene scene_of(const OracleCase& c, bool taut)
{
    Cloth cloth = c.disc ? Cloth::disc({.radius = 0.5, .rings = 3, .density = 0.4})
                         : Cloth::sheet({.rows = taut ? 7u : 5u,
                                         .columns = taut ? 6u : 4u,
                                         .width = 0.66,
                                         .height = 0.8,
                                         .border = c.quadratic ? SheetBorder::half : SheetBorder::full,
                                         .density = 0.5});
    cloth.springs = {{3000, c.damping}, {2000, c.damping / 2}, {30, c.quadratic ? 0 : c.damping / 4}};
    cloth.springs.structural.compliance = 1 / stiffest;
    cloth.springs.shear.compliance = 2 / stiffest;
    cloth.springs.bend.compliance = 4 / stiffest;
    cloth.springs.structural.limit = cloth.springs.shear.limit = c.limit;
    cloth.springs.bend.role = c.bend;
    if (c.quadratic) {
        cloth.springs.bend_model = BendModel::quadratic;
        cloth.springs.bending_stiffness = 0.5;
    }
    cloth.damping = 0.7;
    cloth.pin(std::uint32_t{c.disc ? 3u : 1u});
    cloth.pin(
        Attachment(std::uint32_t{c.disc ? 30u : 14u}, {{.time = 0}, {.time = 1, .position = {1, 0, 0}}}));
    if (taut && c.disc)
        for (std::uint32_t hem = 19; hem < 37; ++hem) cloth.pin(hem);
    if (taut && !c.disc)
        for (const Edge edge : {Edge::top, Edge::bottom, Edge::left, Edge::right}) cloth.pin(edge);
    Scene scene;
    scene.method = c.implicit_euler ? Method::mass_spring : Method::constraint;
    if (c.implicit_euler) scene.integrator = Integrator::implicit_euler;
    scene.newton_multigrid.resists = c.resists;
    scene.newton_multigrid.order = c.second_order ? 2 : 1;
    scene.newton_multigrid.enforcement = c.remembers ? Enforcement::multiplier : Enforcement::penalty;
    scene.newton_multigrid.contact_stiffness = contact_stiffness;
    scene.newton_multigrid.friction_speed = 0.05;
    if (c.contact) {
        scene.add(Plane{.point = {0, -0.008, 0}, .normal = {0.05, 1, -0.1}, .friction = 0.3 * c.slippery});
        scene.add(Sphere{.centre = {0.1, -0.275, 0.02},
                         .radius = 0.285,
                         .friction = 0.5 * c.slippery,
                         .keyframes = {{0, {}, {}}, {1, {0.1, 0.2, -0.3}, {0, 40, 0}}}});
    }
    scene.add(cloth);
    return scene;
}

/// A cloth in some state, for the solver and for the oracle.
struct Bench {
    /// Every node is moved by up to `shake` m, after the cloth is stretched by `stretch`, and moves at up to
    /// `speed` m/s.
    Bench(const OracleCase& c, unsigned seed, double shake, double speed, double stretch = 0,
          bool taut = false)
        : scene(scene_of(c, taut)), model(scene.cloth(0), scene)
    {
        oracle::StepInput input{.cloth = scene.cloth(0), .scene = scene, .dt = dt};
        if (c.implicit_euler) input.scene.method = Method::mass_spring;
        if (c.disc) input.triangles.assign(model.shape.triangles().begin(), model.shape.triangles().end());
        if (c.disc)
            for (std::uint32_t v = 0; v < model.node_count(); ++v)
                input.numbers.push_back(static_cast<int>(model.shape.node(v)));
        const std::uint32_t count = model.node_count();
        for (std::uint32_t vertex = 0; vertex < count; ++vertex)
            input.rest.push_back(
                oracle::point_of(to_double(model.shape.positions[model.shape.node(vertex)])));
        std::mt19937 engine(seed);
        std::uniform_real_distribution<double> unit(-1, 1);
        const auto any = [&](double size) {
            const double x = unit(engine), y = unit(engine), z = unit(engine);
            return Vec3d{size * x, size * y, size * z};
        };
        for (std::uint32_t vertex = 0; vertex < count; ++vertex) {
            const std::uint32_t node = model.shape.node(vertex);
            Vec3& x = model.shape.positions[node];
            x = to_float(to_double(x) * (1 + stretch) + any(shake));
            const Vec3d v = any(speed);
            if (model.masses.inverse(node) > 0) model.shape.velocities[node] = to_float(v);
            input.position.push_back(oracle::point_of(to_double(x)));
            input.velocity.push_back(oracle::point_of(to_double(model.shape.velocities[node])));
            input.is_pinned.push_back(!(model.masses.inverse(node) > 0));
            input.destination.push_back(input.position.back());
        }
        if (c.second_order) {  // a pin ends at its target, and its velocity has no meaning
            for (std::uint32_t vertex = 0; vertex < count; ++vertex) {
                const Vec3d v = to_double(model.shape.velocities[model.shape.node(vertex)]);
                way.push_back(oracle::point_of(to_double(to_float(v * dt + any(0.3 * speed * dt)))));
                before.push_back(oracle::point_of(to_double(to_float(v + any(0.3 * speed)))));
            }
        }
        attached.resize(1);
        for (const AttachedNode& a : model.attachments.nodes) {
            const Vec3 x = model.shape.positions[a.node];
            attached[0].push_back({x.x + 0.01f, x.y + 0.002f, x.z});
            for (std::uint32_t vertex = 0; vertex < count; ++vertex)
                if (model.shape.node(vertex) == a.node)
                    input.destination[vertex] = oracle::point_of(to_double(attached[0].back()));
        }
        for (const Collider& collider : scene.colliders) colliders.push_back(placed_at(collider, 0.5));
        for (PlacedCollider& placed : colliders)  // it has moved for half of its second
            if (placed.moves) placed.centre = placed.centre - placed.velocity * 0.5;
        input.colliders = colliders;
        if (c.remembers) input.softest = model.limits.softest(dt);
        if (c.second_order) input = ImplicitStep::second_order(std::move(input), way, before);
        step.emplace(std::move(input));
    }

    void run(PassRunner& runner, std::vector<Call> calls) const
    {
        tell_the_step_before(runner);
        const std::uint32_t parity_after = 1;
        static std::uint64_t programs = 0;
        runner.run({++programs, std::move(calls), parity_after},
                   {dt, static_cast<std::uint32_t>(colliders.size()), colliders, true, attached});
    }
    /// Writes the previous step to where the solver keeps it.
    void tell_the_step_before(PassRunner& runner) const
    {
        const SolverLevel& level = model.hierarchy.levels.front();
        const auto write = [&](int number, std::uint32_t node, double value) {
            const auto place = static_cast<int>(node) / level.columns;
            const int at = level.base + (model.hierarchy.history_plane + number) * level.size +
                           Hierarchy::offset(level, place, static_cast<int>(node) - place * level.columns);
            const auto written = static_cast<float>(value);
            runner.write_solver_numbers(0, static_cast<std::size_t>(at), {&written, 1});
        };
        for (std::uint32_t vertex = 0; vertex < way.size(); ++vertex)
            for (int k = 0; k < 3; ++k) {
                write(history_way + k, model.shape.node(vertex), way[vertex][k]);
                write(history_velocity + k, model.shape.node(vertex), before[vertex][k]);
                if (k == 0) write(history_step, model.shape.node(vertex), dt);
            }
    }
    /// The calls up to the first evaluation of a step.
    std::vector<Call> look() const
    {
        std::vector<Call> calls;
        append_attachments(model, 0, 0, 0, calls);
        append_linear_system(model, 0, 0, calls);
        return calls;
    }

    Scene scene;
    ClothModel model;
    std::vector<PlacedCollider> colliders;
    std::vector<std::vector<Vec3>> attached;
    std::vector<Point> way, before;  ///< m, m/s, by vertex: the previous step, if there was one
    std::optional<ImplicitStep> step;
};

/// A bench in which the oracle's differences cross no corner.
Bench clear_bench(const OracleCase& c, double shake, double speed, double stretch = 0)
{
    for (unsigned seed = 1;; ++seed) {
        Bench bench(c, seed, shake, speed, stretch);
        const Vector& t = bench.step->start();
        if (seed == 1000 || bench.step->nearest_corner(t) > 0x1p-15) return bench;
    }
}

struct Machine {
    std::string name;
    std::unique_ptr<PassRunner> runner;
    bool on_host = true, exact = false;
};

// Tolerances. The reference computes in double and is read as floats, with a relative rounding of 2^-24. A
// mesh's rest lengths are floats, with as much rounding of the stiffest spring's force over its whole length,
// k l. The oracle's differences have errors of 5e-10 of a force and 1e-9 of a stiffness, which is less. In
// float a length of up to 0.3 m is a difference of positions of up to 1 m: springs are off by their stiffness
// times four roundings of 1 m, up to 12 springs at a node, and contact by as much of its own; directions, and
// stiffness across them, by that over a length of 0.15 m.
double force_tolerance(const Machine& machine, double largest)
{
    if (machine.exact) return 2 * rounding * (largest + stiffest * 0.3);
    return 4 * rounding * (12 * stiffest + contact_stiffness) + 4 * rounding * largest;
}
double block_tolerance(const Machine& machine, double largest)
{
    return (machine.exact ? 4 : 4 * 4 / 0.15) * rounding * (largest + stiffest);
}

void expect_near(const Vector& found, const Vector& expected, double tolerance, const std::string& what)
{
    ASSERT_EQ(found.size(), expected.size()) << what;
    for (Eigen::Index k = 0; k < found.size(); ++k)
        ASSERT_NEAR(found[k], expected[k], tolerance) << what << ": vertex " << k / 3 << ", number " << k % 3;
}

/// Compares block by block, each relative to its own size.
void expect_near(const Machine& machine, const Matrix& found, const Matrix& expected, const std::string& what)
{
    ASSERT_EQ(found.rows(), expected.rows()) << what;
    for (Eigen::Index i = 0; i < found.rows(); i += 3)
        for (Eigen::Index j = 0; j < found.cols(); j += 3) {
            const Block a = found.block<3, 3>(i, j), b = expected.block<3, 3>(i, j);
            const double off = (a - b).lpNorm<Eigen::Infinity>();
            ASSERT_LE(off, block_tolerance(machine, b.lpNorm<Eigen::Infinity>()))
                << what << ": vertices " << i / 3 << " and " << j / 3 << "\n"
                << a << "\ninstead of\n"
                << b;
        }
}

class StepOracle : public testing::TestWithParam<std::tuple<OracleCase, Backend>> {
protected:
    static OracleCase the_case() { return std::get<0>(GetParam()); }
    /// On the backend of this test: the CPU's with each instruction set.
    static std::vector<Machine> machines_of(const ClothModel& model)
    {
        std::vector<Machine> machines;
        SimulationOptions options = test::on(std::get<1>(GetParam()));
        options.threads = 2;
        if (options.backend == Backend::reference)
            machines.push_back({"reference", make_reference_runner({&model, 1}), true, true});
        if (options.backend == Backend::vulkan)
            machines.push_back({"vulkan", make_vulkan_runner({&model, 1}, options), false});
        if (options.backend == Backend::cpu)
            for (const cpu::Kernels* kernels : cpu::available_kernels()) {
                options.instruction_set = kernels->name;
                machines.push_back({kernels->name, make_cpu_runner({&model, 1}, options)});
            }
        return machines;
    }
};

TEST_P(StepOracle, HasTheForcesTheEnergyAndTheOperator)
{
    const OracleCase c = the_case();
    Bench bench = clear_bench(c, 0.02, 1);
    const ImplicitStep& step = *bench.step;
    const Vector t = step.start();
    ASSERT_GT(step.nearest_corner(t), 0x1p-15);
    for (Machine& machine : machines_of(bench.model)) {
        const std::string& who = machine.name;
        bench.run(*machine.runner, bench.look());
        const SolverArena arena(bench.model, *machine.runner, machine.on_host);
        // Of second order a pin starts from where its step before led, a sum of up to 0.5 m.
        const double place = c.second_order ? rounding * 0.5 : 0;
        expect_near(arena.vector(plane_way), t, 2 * rounding * 0.05 + place, who + ", start");
        // On the CPU y is rounded where it is made of terms of up to 1 m/s.
        expect_near(arena.vector(plane_aim), step.aim(), 4 * rounding * 0.05 + place, who + ", aim");

        const Vector force = step.force(t);
        const Matrix newton = step.newton_matrix(t), coarse = step.coarse_matrix(t);
        expect_near(arena.vector(plane_residual), force,
                    force_tolerance(machine, force.lpNorm<Eigen::Infinity>()), who + ", force");
        expect_near(machine, arena.matrix(), newton, who + ", operator");
        expect_near(machine, arena.matrix(true), coarse, who + ", couplings of the coarser level");
        const std::vector<Block> diagonal = arena.diagonal();
        for (std::size_t i = 0; i < diagonal.size(); ++i) {
            const auto at = static_cast<Eigen::Index>(3 * i);
            const Block b = newton.block<3, 3>(at, at);
            EXPECT_LE((diagonal[i] - b).lpNorm<Eigen::Infinity>(),
                      block_tolerance(machine, b.lpNorm<Eigen::Infinity>()))
                << who << ", diagonal of vertex " << i;
        }
        // Energies: a spring's error of length times its force, and there are some hundred.
        const double energy = step.energy(t, Kind::spring) + step.energy(t, Kind::inertia);
        const double contact = step.energy(t, Kind::contact);
        const double part = machine.exact ? 4 * rounding : 64 * rounding;
        EXPECT_NEAR(machine.runner->solver_scalar(0, scalar_energy), energy, part * (energy + 10)) << who;
        EXPECT_NEAR(machine.runner->solver_scalar(0, scalar_contact_energy), contact, part * (contact + 10))
            << who;
        if (c.contact) {
            EXPECT_GT(contact, 0.01) << "nothing to see";
        }
    }
}

TEST_P(StepOracle, HasTheProductOfTheOperator)
{
    // The first iteration of conjugate gradients without a preconditioner has the direction p = r.
    const OracleCase c = the_case();
    Bench bench = clear_bench(c, 0.02, 1);
    bench.model.plan.newton.preconditioner = Preconditioner::none;
    const Vector t = bench.step->start();
    const Matrix newton = bench.step->newton_matrix(t);
    for (Machine& machine : machines_of(bench.model)) {
        std::vector<Call> calls = bench.look();
        append_linear_start(bench.model, 0, 0, calls);
        append_linear_iterations(bench.model, 0, 0, 1, calls);
        bench.run(*machine.runner, calls);
        const SolverArena arena(bench.model, *machine.runner, machine.on_host);
        const Vector p = arena.vector(plane_direction), product = newton * p;
        EXPECT_GT(p.norm(), 1);
        // Of each row a sum of up to 27 products.
        const double size = newton.cwiseAbs().rowwise().sum().maxCoeff() * p.lpNorm<Eigen::Infinity>();
        expect_near(arena.vector(plane_applied), product, (machine.exact ? 4 : 64) * rounding * size,
                    machine.name + ", product");
    }
}

/// Not on Vulkan, which has the CPU's bits (solver_pass_test.cpp): completely solved steps take too long
/// there.
class StepEnd : public StepOracle {};

TEST_P(StepEnd, IsWhereTheEnergyIsLeast)
{
    const OracleCase c = the_case();
    // Pinned along its border and stretched by 5 %, so that all springs pull and there is only one minimum.
    Bench bench(c, 1, 0.002, 0.3, 0.05, true);
    NewtonMultigridOptions& options = bench.model.plan.newton;
    options.newton_iterations = 120;
    options.newton_tolerance = 1e-6;
    options.linear_iterations = 200;
    options.linear_tolerance = 1e-4;
    const ImplicitStep& step = *bench.step;
    int steps = 0;
    Vector least = step.minimum(steps);
    ASSERT_LT(steps, 200) << "the oracle does not find it";
    if (c.contact) {  // once more, with the resulting normal forces
        oracle::StepInput renewed = step.input();
        renewed.pressed = step.pressed(least);
        const Vector before = least;
        least = ImplicitStep(std::move(renewed)).minimum(steps);
        ASSERT_LT(steps, 200) << "the oracle does not find it";
        EXPECT_GT((least - before).lpNorm<Eigen::Infinity>(), 1e-4) << "nothing to see";
    }
    EXPECT_GT((least - step.start()).lpNorm<Eigen::Infinity>(), 1e-4);
    // A step ends when r . A^-1 r is below 1e-12 of the load, |y - dt v|^2 in the norm of inertia; no node is
    // further off than if the lightest one had all of that. The velocity read is a float, and so are a mesh's
    // rest lengths of up to 0.2 m. In float a node ends where lengths and gaps with errors of up to four
    // roundings of 1 m are satisfied, and a residual of 1e-6 is never reached.
    const double of_tolerance = 1e-6 * step.load_length();
    const double of_reading = rounding * least.lpNorm<Eigen::Infinity>();
    constexpr double of_rest_lengths = 0.2 * rounding, of_float = 4 * rounding;
    for (Machine& machine : machines_of(bench.model)) {
        std::vector<Call> calls{{Pass::solve_reset, 0, 0, 0}};
        append_constraint_step(bench.model, 0, 0, 0, calls);
        bench.run(*machine.runner, calls);
        std::vector<float> x, v;
        machine.runner->read(0, Resource::position, 1, x);
        machine.runner->read(0, Resource::velocity, 1, v);
        Vector found(least.size()), place(least.size()), start(least.size());
        for (std::uint32_t vertex = 0; vertex < bench.model.node_count(); ++vertex)
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t at = 3 * bench.model.shape.node(vertex) + k;
                found[3 * vertex + k] = double{v[at]} * step.input().dt;
                place[3 * vertex + k] = double{x[at]};
                start[3 * vertex + k] = step.input().position[vertex][k];
            }
        // With contact there are two such ends, one after the other, and the oracle's own stop at 2e-9 m.
        const double of_ends = c.contact ? 3 * (of_tolerance + 2e-9) : of_tolerance;
        const double bar =
            machine.exact ? of_ends + of_reading + (c.disc || c.quadratic ? of_rest_lengths : 0) : of_float;
        EXPECT_LE((found - least).lpNorm<Eigen::Infinity>(), bar) << machine.name;
        EXPECT_LE((place - start - least).lpNorm<Eigen::Infinity>(), bar + rounding) << machine.name;
        if (machine.exact) {
            // Limits with memory may leave ten times as much without colliders.
            const double residual = c.remembers && !c.contact ? 1e-5 : 1e-6;
            EXPECT_LE(machine.runner->solver_scalar(0, scalar_residual_last), residual) << machine.name;
        }
    }
}

std::string name_of_case(const testing::TestParamInfo<std::tuple<OracleCase, Backend>>& info)
{
    return std::string(std::get<0>(info.param).name) + "_" + name_of(std::get<1>(info.param));
}
INSTANTIATE_TEST_SUITE_P(Cases, StepOracle,
                         testing::Combine(testing::ValuesIn(cases),
                                          testing::Values(Backend::reference, Backend::cpu, Backend::vulkan)),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(Cases, StepEnd,
                         testing::Combine(testing::ValuesIn(cases),
                                          testing::Values(Backend::reference, Backend::cpu)),
                         name_of_case);

TEST(Oracle, HasTheExactHessianForNewtonsWhereEverySpringPulls)
{
    // Stretched by 15 %, and nothing is folded: the differences of E are of fourth order over 2^-13 m, and
    // leave (2^-13 / 0.15)^4 of the stiffness, and of forces of some 100 N their rounding of 1e-16 over 2^-26
    // m2.
    for (const OracleCase& c :
         {OracleCase{.name = "disc", .disc = true, .bend = SpringRole::off, .damping = 0.2},
          OracleCase{.name = "stiff bend", .bend = SpringRole::constraint},
          OracleCase{.name = "quadratic", .quadratic = true},
          OracleCase{.name = "disc quadratic", .disc = true, .quadratic = true}}) {
        const Bench bench(c, 1, 0.004, 0.1, 0.15);
        const Matrix exact = bench.step->hessian(bench.step->start(), 0x1p-13),
                     newton = bench.step->newton_matrix(bench.step->start());
        EXPECT_GT(newton.cwiseAbs().maxCoeff(), 1e4) << c.name;
        EXPECT_LE((exact - newton).cwiseAbs().maxCoeff(), 1e-8 * stiffest) << c.name;
        // But not if some springs are slack.
        const Bench crumpled(c, 1, 0.02, 0.1);
        EXPECT_GT((crumpled.step->hessian(crumpled.step->start(), 0x1p-13) -
                   crumpled.step->newton_matrix(crumpled.step->start()))
                      .cwiseAbs()
                      .maxCoeff(),
                  0.1 * stiffest)
            << c.name;
    }
}

/// m: the mean height of a sheet's nodes against where they were, after the first Newton step of a sheet at
/// rest 1 mm above a plane.
double first_newton_step(Backend backend)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.add(Cloth::sheet({.rows = 4, .columns = 5, .density = 0.3}));
    scene.cloth_handle(0)->position = {0, scene.cloth(0).thickness + 1e-3, 0};
    scene.add(Plane{});
    const ClothModel model(scene.cloth(0), scene);
    const std::unique_ptr<PassRunner> runner = test::make_runner(backend, model);
    std::vector<Call> calls;
    append_linear_system(model, 0, 0, calls);
    append_linear_start(model, 0, 0, calls);
    append_linear_iterations(model, 0, 0, 10, calls);
    calls.push_back({Pass::search_begin, 0, 0, 0});
    calls.push_back({Pass::newton_move, 0, 0, 0});
    const std::vector<PlacedCollider> colliders = {placed_at(scene.colliders[0], 0)};
    runner->run({1, std::move(calls), 0}, {1.0 / 60, 1, colliders, true, {}});
    const Vector t = SolverArena(model, *runner, backend != Backend::vulkan).vector(plane_way);
    double sum = 0;
    for (Eigen::Index k = 1; k < t.size(); k += 3) sum += t[k];
    return sum / static_cast<double>(t.size() / 3);
}

// Gravity alone would take it 2.7 mm down. It stops where the plane carries it: at the depth d with
// k d = m g, where k is 100 m / dt^2. A gap of 3 mm is known to four roundings of itself.
TEST(NewtonStep, EndsWhereAPlaneCarriesTheNodes)
{
    const double depth = 9.81 / (100 * 60 * 60);
    for (const Backend backend : test::backends())
        EXPECT_NEAR(first_newton_step(backend), -1e-3 - depth, 4 * rounding * 3e-3) << name_of(backend);
}

}  // namespace
}  // namespace pliant
