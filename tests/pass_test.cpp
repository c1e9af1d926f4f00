// Every pass of the table on every backend, with odd sizes: cpu (packs of 4, 8 and 16 lanes, 1, 2, 3 and 7
// threads) and vulkan must agree bit by bit, and both must match the double-precision reference up to
// rounding.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "backend/pass_runner.hpp"
#include "backend/vulkan/vulkan_runner.hpp"
#include "solve/frame.hpp"
#include "solve/mass_spring.hpp"
#include "test_bits.hpp"
#include "test_cloths.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

struct PassCase {
    const char* name;
    std::uint32_t rows, columns;
    bool mesh, list;
    Integrator integrator = Integrator::symplectic_euler;
    bool graded = false;  ///< springs have numbers of their own
};
void PrintTo(const PassCase& c, std::ostream* out) { *out << c.name; }

// 1, 2, 3, 31, 1023, ...: widths around the packs of 4, 8, 16 lanes, blocks of 256 and their trees of one to
// three levels.
const PassCase cases[] = {
    {"sheet_2x2", 2, 2, false, false},
    {"sheet_2x9", 2, 9, false, false},
    {"sheet_3x1023", 3, 1023, false, false},
    {"sheet_31x33", 31, 33, false, false},
    {"sheet_17x16", 17, 16, false, false},
    {"sheet_257x129", 257, 129, false, false},
    {"sheet_9x2", 9, 2, false, false},
    {"sheet_300x301", 300, 301, false, false},
    {"list_2x2", 2, 2, false, true},
    {"list_2x9", 2, 9, false, true},
    {"list_31x33", 31, 33, false, true},
    {"list_257x129", 257, 129, false, true},
    {"mesh_2x2", 2, 2, true, true},
    {"mesh_3x5", 3, 5, true, true},
    {"mesh_31x33", 31, 33, true, true},
    {"mesh_65x67", 65, 67, true, true},
    {"mesh_3x341", 3, 341, true, true},
    {"graded_sheet_9x13", 9, 13, false, true, Integrator::symplectic_euler, true},
    {"graded_mesh_17x13", 17, 13, true, true, Integrator::symplectic_euler, true},
    {"explicit_31x33", 31, 33, false, true, Integrator::explicit_euler},
    {"runge_kutta_31x33", 31, 33, false, true, Integrator::runge_kutta_4},
    {"runge_kutta_mesh", 17, 13, true, true, Integrator::runge_kutta_4, true},
};

constexpr double dt = 1e-4;

Scene scene_of(const PassCase& c)
{
    Cloth cloth = c.mesh ? Cloth::mesh(test::irregular_mesh(c.rows, c.columns), {.density = 0.2})
                         : test::flat_sheet(c.rows, c.columns, 1.0, 0.8);
    cloth.springs = {{1000, 0.02}, {500, 0.03}, {10, 0.004}};
    if (c.list && !c.mesh) cloth.formulation = Formulation::spring_list;
    if (c.graded) {
        cloth.springs.bend_model = BendModel::quadratic;
        if (auto* sheet = std::get_if<SheetOptions>(&cloth.shape)) sheet->border = SheetBorder::half;
    }
    cloth.pin(Attachment(std::uint32_t{1}, {{.time = 0}, {.time = 1, .position = {1, 0, 0}}}));
    Scene scene;
    scene.integrator = c.integrator;
    scene.time.substeps = 1;
    scene.add(cloth);
    scene.air = {.velocity = {3, 0.5, -1}, .density = 1.2, .drag = 1.1, .lift = 0.4};
    // All shapes and both responses, each touching some nodes; one of them moving.
    scene.add(Sphere{.centre = {0.1, -0.2, 0.1}, .radius = 0.25, .friction = 0.3});
    scene.add(Plane{.point = {0, -0.03, 0}, .normal = {0.1, 1, 0}, .friction = 0.2});
    scene.add(Box{.centre = {-0.3, 0, 0.2}, .size = {0.2, 0.1, 0.3}, .rotation = {10, 20, 30}});
    scene.add(Capsule{.start = {0.3, 0, -0.3},
                      .end = {0.2, 0.05, -0.1},
                      .radius = 0.05,
                      .keyframes = {{0, {0, 0, 0}, {0, 0, 0}}, {1, {0, 0.1, 0}, {0, 90, 0}}}});
    scene.add(Sphere{.centre = {0.35, 0, 0.3}, .radius = 0.06, .response = ContactResponse::paper});
    scene.add(TaperedCapsule{.start = {-0.35, -0.02, -0.3},
                             .end = {-0.15, 0.02, -0.25},
                             .start_radius = 0.03,
                             .end_radius = 0.07});
    return scene;
}

/// The results of a cloth's program, one step from the same state.
std::map<Resource, std::vector<float>> results_of(PassRunner& runner, const ClothModel& model,
                                                  std::span<const PlacedCollider> colliders,
                                                  std::uint32_t grabbed = 0)
{
    Program program{1, {}, 0};
    program.parity_after = append_frame({&model, 1}, 1, 0, program.calls, grabbed);
    append_drawing(model, 0, program.parity_after, program.calls);
    // A moving pin goes 1 m/s.
    std::vector<std::vector<Vec3>> attached(1);
    for (const AttachedNode& a : model.attachments.nodes) {
        const Vec3 x = model.shape.positions[a.node];
        attached[0].push_back({x.x + static_cast<float>(dt), x.y, x.z});
    }
    const GrabInput grab{0, model.node_count() - 1, {0.3, 0.2, -0.4}, 11.0, 0.25};
    runner.run(program,
               {dt, static_cast<std::uint32_t>(colliders.size()), colliders, true, attached, {}, grab});
    std::map<Resource, std::vector<float>> results;
    std::vector<Resource> computed = {Resource::position, Resource::velocity, Resource::normal,
                                      Resource::strain, Resource::measures};
    if (model.feels_air()) computed.push_back(Resource::external_force);
    if (!model.plan.node_centric) computed.push_back(Resource::spring_force);
    for (const Resource resource : computed)
        runner.read(0, resource, program.parity_after, results[resource]);
    return results;
}

class PassParity : public testing::TestWithParam<PassCase> {};

TEST_P(PassParity, AllBackendsAgree)
{
    const Scene scene = scene_of(GetParam());
    const ClothModel model = test::shaken_model(scene);
    std::vector<PlacedCollider> colliders;
    for (const Collider& collider : scene.colliders) colliders.push_back(placed_at(collider, 0.5));

    std::map<Resource, std::vector<float>> expected;
    for (const test::CpuWay& way : test::cpu_ways()) {
        const auto results = results_of(*make_cpu_runner({&model, 1}, way.options()), model, colliders);
        if (expected.empty()) expected = results;
        test::expect_same_bits(expected, results, testing::PrintToString(way));
    }

    if (test::has_vulkan) {
        const auto runner = make_vulkan_runner({&model, 1}, test::on(Backend::vulkan));
        test::expect_same_bits(expected, results_of(*runner, model, colliders), "vulkan");
        EXPECT_EQ(runner->validation_messages(), 0u);
    }

    // The reference, up to the rounding of some dozen operations; forces relative to the terms that cancel in
    // them.
    const auto exact = results_of(*make_reference_runner({&model, 1}), model, colliders);
    const double force_scale =
        1000 * (0.2 + 2);  // k l + what shaking adds, N: more than any spring here carries
    double least_mass = 1e30;
    for (const double m : model.masses.kg) least_mass = std::min(least_mass, m);
    constexpr double rounding = 0x1p-24;
    const auto expect_near = [&](Resource resource, double tolerance) {
        EXPECT_LE(test::largest_difference(expected.at(resource), exact.at(resource)), tolerance)
            << "resource " << static_cast<int>(resource);
    };
    // Each of 12 springs differs by k times the rounding of its ends, positions of up to 1 m; twice that, for
    // the roundings after it, and those of the velocity itself.
    const double velocity_tolerance = 2 * 12 * 1000 * rounding * dt / least_mass + 64 * rounding;
    expect_near(Resource::velocity, velocity_tolerance);
    expect_near(Resource::position, velocity_tolerance * dt + 8 * rounding);
    expect_near(Resource::external_force, 64 * rounding);
    if (!model.plan.node_centric) expect_near(Resource::spring_force, 64 * rounding * force_scale);
    // Normals come from sides that are differences of rounded positions; where a shaken sheet's triangles
    // cancel they have no direction at all, so the bound is on the mean square.
    const auto &n = expected.at(Resource::normal), &m = exact.at(Resource::normal);
    ASSERT_EQ(n.size(), m.size());
    double square = 0;
    for (std::size_t i = 0; i < n.size(); ++i) square += std::pow(static_cast<double>(n[i]) - m[i], 2);
    const double nodes_across = std::max(GetParam().rows, GetParam().columns);
    EXPECT_LE(std::sqrt(3 * square / static_cast<double>(n.size())), 16 * rounding * nodes_across);

    // Stretch is a difference of positions of up to 1 m over rest lengths of about 0.5 / nodes_across.
    const double stretch_tolerance = 64 * rounding * nodes_across;
    expect_near(Resource::strain, stretch_tolerance);
    const auto &root = expected.at(Resource::measures), &exact_root = exact.at(Resource::measures);
    const auto expect_measure = [&](std::size_t component, double tolerance) {
        EXPECT_NEAR(root[root.size() - 8 + component], exact_root[exact_root.size() - 8 + component],
                    tolerance)
            << "measure " << component;
    };
    const double springs = static_cast<double>(model.springs.measured_count);
    const auto exact_of = [&](std::size_t component) {
        return std::abs(exact_root[exact_root.size() - 8 + component]);
    };
    expect_measure(0, stretch_tolerance);                                // max_stretch
    expect_measure(1, 32 * rounding);                                    // max_penetration
    expect_measure(2, 4 * velocity_tolerance * std::sqrt(exact_of(2)));  // max_speed2
    expect_measure(3, stretch_tolerance * springs);                      // stretch_sum
    expect_measure(4, 4 * velocity_tolerance * exact_of(4));             // kinetic_energy, of about 1 m/s
    // Energies are squares of extensions of about 5 % of a rest length.
    expect_measure(5, exact_of(5) * 2 * stretch_tolerance / 0.05);
    expect_measure(6, 64 * rounding * (exact_of(6) + 1));  // height_moment
    expect_measure(7, 0);                                  // non_finite
}

INSTANTIATE_TEST_SUITE_P(Sizes, PassParity, testing::ValuesIn(cases),
                         [](const auto& param) { return std::string(param.param.name); });

TEST(PassTable, EveryPassIsRunByTheCasesAbove)
{
    std::map<Pass, int> runs;
    for (const PassCase& c : cases) {
        const Scene scene = scene_of(c);
        const ClothModel model(scene.cloth(0), scene);
        std::vector<Call> calls;
        append_frame({&model, 1}, 1, 0, calls, 0);
        append_drawing(model, 0, 1, calls);
        for (const Call& call : calls) ++runs[call.pass];
    }
    for (std::size_t p = 0; p < all_passes().size(); ++p) {
        const auto pass = static_cast<Pass>(p);
        if (!is_solver_pass(pass) && !is_body_pass(pass)) {  // see solver_pass_test.cpp, body_pass_test.cpp
            EXPECT_GT(runs[pass], 0) << all_passes()[p].name;
        }
    }
}

TEST(Formulations, NodeCentricAndSpringListGiveTheSameBits)
{
    for (const auto& [rows, columns] : {std::pair{2u, 2u}, {2u, 9u}, {31u, 33u}, {257u, 129u}}) {
        std::vector<float> velocities[2];
        for (const bool list : {false, true}) {
            const Scene scene = scene_of({"", rows, columns, false, list});
            const ClothModel model = test::shaken_model(scene);
            auto results = results_of(*make_cpu_runner({&model, 1}, {}), model, {});
            velocities[list] = results[Resource::velocity];
        }
        const test::BitDifferences found = test::bit_differences(velocities[0], velocities[1]);
        EXPECT_EQ(found.count, 0u) << rows << " x " << columns << ", first at " << found.first;
    }
}

TEST(MeasureTree, LevelsHoldEveryBlock)
{
    for (const std::uint32_t nodes : {1u, 2u, 255u, 256u, 257u, 65536u, 65537u, 7817616u}) {
        const MeasureTree tree(nodes);
        std::uint32_t count = nodes, first = 0;
        for (const auto& level : tree.levels) {
            count = (count + 255) / 256;
            EXPECT_EQ(level.count, count);
            EXPECT_EQ(level.first, first);
            first += count;
        }
        EXPECT_EQ(tree.levels.back().count, 1u);
        EXPECT_EQ(tree.value_count, first);
    }
}

TEST(Differences, AreInfiniteForWhatIsNotANumberOrNotThere)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    using Numbers = std::vector<float>;
    EXPECT_EQ(test::largest_difference(Numbers{1, 2}, Numbers{1, 2.5f}), 0.5);
    for (const auto& [a, b] : {std::pair<Numbers, Numbers>{{1, nan}, {1, nan}},
                               {{nan, 1}, {0, 1}},
                               {{1, 2}, {1, nan}},
                               {{inf}, {inf}},
                               {{1, 2}, {1}},
                               {{}, {}}}) {
        EXPECT_TRUE(std::isinf(test::largest_difference(a, b)));
        EXPECT_GT(test::bit_differences(a, b).count, 0u);
    }
    EXPECT_EQ(test::bit_differences(Numbers{1, 0}, Numbers{1, 0}).count, 0u);
    EXPECT_EQ(test::bit_differences(Numbers{1, 0.0f}, Numbers{1, -0.0f}).first, 1u);
}

TEST(Differences, ExtremesKeepWhatIsNotANumber)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const std::vector<double>& all : {std::vector<double>{}, {nan}, {1, nan}, {nan, 1}, {1, nan, 2}}) {
        test::Largest largest;
        test::Smallest smallest;
        for (const double a : all) largest.add(a), smallest.add(a);
        EXPECT_TRUE(std::isnan(largest.value()) && std::isnan(smallest.value())) << all.size();
    }
    test::Largest largest;
    test::Smallest smallest;
    for (const double a : {-3.0, -1.0, -2.0}) largest.add(a), smallest.add(a);
    EXPECT_EQ(largest.value(), -1);
    EXPECT_EQ(smallest.value(), -3);
}

TEST(Denormals, NeverReachTheState)
{
    // Velocities and forces around the smallest normal float, 1.2e-38: the CPU flushes what is below,
    // llvmpipe does not, and a GPU may do either.
    Cloth cloth = Cloth::sheet({.rows = 5, .columns = 7, .width = 0.9, .height = 0.7, .node_mass = 1.0});
    cloth.springs = {{1e-32, 0}, {1e-33, 0}, {0, 0}};
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.add(cloth);
    ClothModel model(scene.cloth(0), scene);
    for (std::size_t i = 0; i < model.shape.velocities.size(); ++i)
        model.shape.velocities[i] = {3e-39f, static_cast<float>(i) * 1e-38f, 1e-5f};
    std::map<Resource, std::vector<float>> expected;
    for (const test::CpuWay& way : test::cpu_ways()) {
        const auto results = results_of(*make_cpu_runner({&model, 1}, way.options()), model, {}, no_cloth);
        if (expected.empty()) expected = results;
        test::expect_same_bits(expected, results, testing::PrintToString(way));
    }
    if (test::has_vulkan) {
        const auto vulkan = make_vulkan_runner({&model, 1}, test::on(Backend::vulkan));
        test::expect_same_bits(expected, results_of(*vulkan, model, {}, no_cloth), "vulkan");
    }
    EXPECT_EQ(expected.at(Resource::velocity)[0], 0.0f);
    EXPECT_NE(expected.at(Resource::velocity)[2], 0.0f);
}

}  // namespace
}  // namespace pliant
