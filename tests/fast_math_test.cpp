// SimulationOptions::fast_math: a step equals the exact one up to rounding, and exact steps are not affected.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "backend/cpu/kernels.hpp"
#include "backend/vulkan/device.hpp"
#include "pliant/mesh_generators.hpp"
#include "solve/frame.hpp"
#include "test_bits.hpp"
#include "test_errors.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

constexpr double dt = 1e-4;
constexpr double rounding = 0x1p-24;

using State = std::map<Resource, std::vector<float>>;

State state_after_a_step(const ClothModel& model, const SimulationOptions& options)
{
    const auto runner = options.backend == Backend::vulkan
                            ? std::unique_ptr<PassRunner>(make_vulkan_runner({&model, 1}, options))
                            : make_cpu_runner({&model, 1}, options);
    EXPECT_EQ(runner->device_name().find("fast math") != std::string::npos, options.fast_math);
    Program program{1, {}, 0};
    program.parity_after = append_frame({&model, 1}, 1, 0, program.calls);
    runner->run(program, {dt, 0, {}, true});
    State state;
    for (const Resource resource : {Resource::position, Resource::velocity})
        runner->read(0, resource, program.parity_after, state[resource]);
    EXPECT_EQ(runner->validation_messages(), 0u);
    return state;
}

Vec3d at(const std::vector<Vec3>& values, std::size_t i) { return to_double(values[i]); }

/// By node: the sum over its springs of k (l + l0) + c |v_ij|, N, against which forces are rounded.
std::vector<double> force_scales(const ClothModel& model)
{
    std::vector<double> scales(model.node_count(), 0.0);
    const auto add = [&](std::uint32_t i, std::uint32_t j, SpringClass of, double rest_length) {
        const auto k = static_cast<std::size_t>(of);
        const Vec3d d = at(model.shape.positions, j) - at(model.shape.positions, i),
                    v = at(model.shape.velocities, j) - at(model.shape.velocities, i);
        const double scale = model.parameters.stiffness[k] * (std::sqrt(dot(d, d)) + rest_length) +
                             model.parameters.spring_damping[k] * std::sqrt(dot(v, v));
        scales[i] += scale;
        scales[j] += scale;
    };
    if (model.plan.node_centric)
        for_each_sheet_spring(
            *model.shape.sheet, [&](std::uint32_t i, std::uint32_t j, const SheetNeighbour& n) {
                add(i, j, n.spring_class, model.shape.sheet->rest_lengths[static_cast<std::size_t>(n.rest)]);
            });
    else
        for (const Spring& s : model.springs.list) add(s.i, s.j, s.spring_class, s.rest_length);
    return scales;
}

/// The relative error of an inverse length is at most 1.8e-7 for the portable law, and 4e-7 for the machine's
/// (an estimate to 1.5 x 2^-12, one Newton step and its three roundings; Vulkan allows 2 units in the last
/// place). It enters the length once and the direction twice; eight more operations of a spring and the sums
/// of up to 24 springs are rounded in both.
constexpr double force_tolerance = 3 * (1.8e-7 + 4e-7) + 2 * (8 + 24) * rounding;

void expect_near(const ClothModel& model, const State& plain, const State& fast, const std::string& who)
{
    const std::vector<double> scales = force_scales(model);
    const auto component = [](const State& state, Resource resource, std::size_t k) {
        return static_cast<double>(state.at(resource)[k]);
    };
    for (std::size_t k = 0; k < 3 * scales.size(); ++k) {
        const double inverse_mass = model.masses.inverse(k / 3), force = scales[k / 3];
        const double speed =
            std::abs(component(plain, Resource::velocity, k)) + dt * force * inverse_mass + 10 * dt;
        const double velocity = dt * inverse_mass * force * force_tolerance + 8 * rounding * speed;
        ASSERT_NEAR(component(plain, Resource::velocity, k), component(fast, Resource::velocity, k), velocity)
            << who << ": number " << k;
        const double place = std::abs(component(plain, Resource::position, k)) + dt * speed;
        ASSERT_NEAR(component(plain, Resource::position, k), component(fast, Resource::position, k),
                    dt * velocity + 4 * rounding * place)
            << who << ": number " << k;
    }
    EXPECT_NE(plain.at(Resource::velocity), fast.at(Resource::velocity)) << who << " is the plain step";
}

struct FastCase {
    const char* name;
    Cloth (*cloth)();
};
void PrintTo(const FastCase& c, std::ostream* out) { *out << c.name; }

Cloth sheet_by_list()
{
    Cloth cloth = test::flat_sheet(31, 33);
    cloth.formulation = Formulation::spring_list;
    return cloth;
}
Cloth mesh()
{
    Cloth cloth = Cloth::mesh(test::irregular_mesh(17, 19), {.density = 0.3});
    cloth.springs = {{1000, 0.02}, {500, 0.03}, {10, 0.004}};
    return cloth;
}
Cloth body()
{
    Cloth cloth = Cloth::soft_body(icosphere_mesh({.radius = 0.4, .frequency = 7}), {}, {.node_mass = 0.01});
    cloth.springs.structural = {1000, 0.3};
    return cloth;
}
const FastCase cases[] = {{"sheet_31x33", [] { return test::flat_sheet(31, 33); }},
                          {"sheet_3x131", [] { return test::flat_sheet(3, 131); }},
                          {"list", sheet_by_list},
                          {"mesh", mesh},
                          {"body", body}};

/// On one device pipelines of both kinds are there at once.
class FastMath : public testing::TestWithParam<FastCase> {};

TEST_P(FastMath, IsTheStepToRoundingAndLeavesThePlainOneAsItIs)
{
    Scene scene;
    scene.method = Method::mass_spring;
    scene.add(GetParam().cloth());
    const ClothModel model = test::shaken_model(scene);
    const State plain = state_after_a_step(model, {});

    SimulationOptions vulkan = test::on(Backend::vulkan);
    vulkan.fast_math = true;
    expect_near(model, plain, state_after_a_step(model, vulkan), "vulkan");
    vulkan.fast_math = false;
    test::expect_same_bits(plain, state_after_a_step(model, vulkan), "vulkan without");

    for (const cpu::Kernels* kernels : cpu::available_kernels()) {
        SimulationOptions options;
        options.instruction_set = kernels->name;
        options.fast_math = true;
        if (kernels == cpu::available_kernels().front()) {
            EXPECT_ERROR(cpu::choose_kernels(kernels->name, true), bad_usage, kernels->name);
            continue;
        }
        for (const unsigned threads : {1u, 3u}) {
            options.threads = threads;
            expect_near(model, plain, state_after_a_step(model, options), kernels->name);
        }
    }
    test::expect_same_bits(plain, state_after_a_step(model, {}), "cpu without");
}

INSTANTIATE_TEST_SUITE_P(Cloths, FastMath, testing::ValuesIn(cases),
                         [](const auto& param) { return std::string(param.param.name); });

TEST(FastMathAlone, GivesNodesAtOnePlaceNoDirection)
{
    Scene scene;
    scene.add(test::flat_sheet(5, 9));
    ClothModel model(scene.cloth(0), scene);
    for (Vec3& x : model.shape.positions) x = {0.25f, 0.5f, -1};
    SimulationOptions options;
    options.fast_math = true;
    std::vector<SimulationOptions> machines{test::on(Backend::vulkan)};
    machines.front().fast_math = true;
    if (cpu::available_kernels().size() > 1) machines.push_back(options);
    for (const SimulationOptions& machine : machines) {
        const State state = state_after_a_step(model, machine);
        for (std::size_t k = 0; k < state.at(Resource::velocity).size(); ++k)  // the sheet only falls freely
            EXPECT_FLOAT_EQ(state.at(Resource::velocity)[k],
                            k % 3 == 1 ? static_cast<float>(-9.81 * dt) : 0.0f);
    }
}

}  // namespace
}  // namespace pliant
