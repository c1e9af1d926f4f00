// Several steps of a sheet in one pass over its rows (CPU), or in one dispatch (GPU), compared with single
// steps: the same operations in the same order at every node, and thus the same bits.
#include <gtest/gtest.h>

#include <map>

#include "backend/cpu/kernels.hpp"
#include "backend/cpu/sheet_steps.hpp"
#include "backend/vulkan/device.hpp"
#include "backend/vulkan/sheet_tile.hpp"
#include "solve/frame.hpp"
#include "test_bits.hpp"
#include "test_errors.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

using State = std::map<Resource, std::vector<float>>;

constexpr std::uint32_t frame_steps = 19;  // more than are ever taken at once

/// The sphere is in the sheet's middle and rises from step to step.
std::vector<PlacedCollider> rising_sphere(std::uint32_t first_step, std::uint32_t count)
{
    std::vector<PlacedCollider> placed;
    for (std::uint32_t k = 0; k < count; ++k)
        placed.push_back(
            placed_at(Sphere{.centre = {0, -0.15 + 1e-3 * (first_step + k), 0}, .radius = 0.2}, 0));
    return placed;
}

std::unique_ptr<PassRunner> runner_of(const ClothModel& model, const SimulationOptions& options)
{
    if (options.backend == Backend::vulkan) return make_vulkan_runner({&model, 1}, options);
    return make_cpu_runner({&model, 1}, options);
}

/// After a frame's steps, `at_once` of them in a program; measures after the last.
State state_after(const ClothModel& model, const SimulationOptions& options, std::uint32_t at_once)
{
    const auto runner = runner_of(model, options);
    std::uint32_t parity = 0;
    for (std::uint32_t done = 0; done < frame_steps; done += at_once) {
        const std::uint32_t count = std::min(at_once, frame_steps - done);
        Program program{done + 1, {}, 0};
        program.parity_after = append_frame({&model, 1}, count, parity, program.calls);
        const auto colliders = rising_sphere(done, count);
        runner->run(program, {1e-4, 1, colliders, false});
        parity = program.parity_after;
    }
    State state;
    for (const Resource resource : {Resource::position, Resource::velocity, Resource::measures})
        runner->read(0, resource, parity, state[resource]);
    EXPECT_EQ(runner->validation_messages(), 0u);
    return state;
}

struct Size {
    std::uint32_t rows, columns;
};

class SheetSteps : public testing::TestWithParam<Size> {};

TEST_P(SheetSteps, AreTheSameInOnePassOverTheRows)
{
    Scene scene;
    Cloth cloth = test::flat_sheet(GetParam().rows, GetParam().columns);
    cloth.pin(Attachment(std::uint32_t{0}));
    scene.add(cloth);
    const ClothModel model = test::shaken_model(scene);
    const State expected = state_after(model, {.threads = 1}, 1);
    for (const test::CpuWay& way : test::cpu_ways())
        test::expect_same_bits(expected, state_after(model, way.options(), frame_steps),
                               testing::PrintToString(way));
    if (!test::has_vulkan || GetParam().rows == 600) return;  // for the gaps of the CPU's parts
    // 19 steps are divided into pairs of 2 or 4, into 3, and the rest.
    SimulationOptions vulkan = test::on(Backend::vulkan);
    for (vulkan.gpu_substeps = 2; vulkan.gpu_substeps <= vulkan::most_sheet_steps; ++vulkan.gpu_substeps)
        test::expect_same_bits(expected, state_after(model, vulkan, frame_steps),
                               std::to_string(vulkan.gpu_substeps) + " steps in a dispatch");
}

// Rows around what steps and parts need; columns around packs of 4, 8, 16 and chunks of 128.
INSTANTIATE_TEST_SUITE_P(Sizes, SheetSteps,
                         testing::Values(Size{2, 2}, Size{3, 131}, Size{31, 2}, Size{33, 129}, Size{65, 256},
                                         Size{131, 7}, Size{600, 33}),
                         [](const auto& param) {
                             return std::to_string(param.param.rows) + "x" +
                                    std::to_string(param.param.columns);
                         });

TEST(SheetStretches, AreTakenSeveralAtOnceWhereThePartsAreTallEnough)
{
    EXPECT_EQ(cpu::SheetSteps::most_steps(2, 1), cpu::SheetStretch::most_steps);
    EXPECT_EQ(cpu::SheetSteps::most_steps(31, 2), 1u);
    EXPECT_GE(cpu::SheetSteps::most_steps(600, 3), 2u);  // of the sizes above, with gaps to fill
    EXPECT_EQ(cpu::SheetSteps::most_steps(2796, 2), cpu::SheetStretch::most_steps);
}

/// Steps of the dispatches of a frame, and the copy of the state that each reads.
using Shares = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
Shares shares_of(std::uint32_t count, std::uint32_t parity, std::uint32_t most)
{
    std::vector<Call> calls{{Pass::grab, 0, parity, 0}};
    for (std::uint32_t step = 0; step < count; ++step)
        calls.push_back({Pass::sheet_step, 0, (parity + step) % 2, step});
    calls.push_back({Pass::sheet_measure, 0, (parity + count) % 2, count - 1});
    const std::vector<vulkan::Dispatch> dispatches = vulkan::dispatches_of(calls, most);
    EXPECT_EQ(dispatches.front().call.pass, Pass::grab);
    EXPECT_EQ(dispatches.back().call.pass, Pass::sheet_measure);
    Shares shares;
    std::uint32_t step = 0;
    for (std::size_t d = 1; d + 1 < dispatches.size(); ++d) {
        EXPECT_EQ(dispatches[d].call.pass, Pass::sheet_step);
        EXPECT_EQ(dispatches[d].call.index, step);
        step += dispatches[d].steps;
        shares.emplace_back(dispatches[d].steps, dispatches[d].call.parity);
    }
    EXPECT_EQ(step, count);
    return shares;
}

TEST(SheetDispatches, LeaveTheStateInTheCopyWhereSingleStepsLeaveIt)
{
    EXPECT_EQ(shares_of(3, 0, 1), (Shares{{1, 0}, {1, 1}, {1, 0}}));
    EXPECT_EQ(shares_of(8, 0, 2), (Shares{{2, 0}, {2, 1}, {2, 0}, {2, 1}}));
    EXPECT_EQ(shares_of(6, 1, 2), (Shares{{2, 1}, {2, 0}, {1, 1}, {1, 0}}));
    EXPECT_EQ(shares_of(8, 0, 3), (Shares{{3, 0}, {3, 1}, {1, 0}, {1, 1}}));
    EXPECT_EQ(shares_of(9, 0, 4), (Shares{{4, 0}, {4, 1}, {1, 0}}));
    EXPECT_EQ(shares_of(4, 0, 4), (Shares{{3, 0}, {1, 1}}));
    for (std::uint32_t most = 1; most <= vulkan::most_sheet_steps; ++most)
        for (std::uint32_t count = 1; count < 40; ++count) {
            const Shares shares = shares_of(count, 0, most);
            EXPECT_EQ(shares.size() % 2, count % 2) << count << " steps, at most " << most;
            for (const auto& [steps, parity] : shares) EXPECT_LE(steps, most);
        }
}

TEST(SheetDispatches, TakeTogetherOnlyStepsWithNothingBetween)
{
    const std::vector<Call> calls = {
        {Pass::sheet_step, 0, 0, 0}, {Pass::sheet_step, 1, 0, 0}, {Pass::sheet_step, 0, 1, 1},
        {Pass::attach, 0, 1, 1},     {Pass::sheet_step, 0, 0, 2}, {Pass::sheet_step, 0, 0, 0},
        {Pass::list_step, 0, 1, 1},  {Pass::list_step, 0, 0, 2},
    };
    for (std::uint32_t most = 1; most <= vulkan::most_sheet_steps; ++most)
        EXPECT_EQ(vulkan::dispatches_of(calls, most).size(), calls.size());
}

TEST(SheetDispatches, HaveTilesOnEveryDevice)
{
    vk::PhysicalDeviceLimits limits;
    limits.maxComputeWorkGroupSize[0] = limits.maxComputeWorkGroupInvocations = 128;
    for (const std::uint32_t bytes : {16u << 10, 32u << 10, 64u << 10})  // Vulkan promises the least of them
        for (std::uint32_t steps = 2; steps <= vulkan::most_sheet_steps; ++steps) {
            limits.maxComputeSharedMemorySize = bytes;
            const vulkan::SheetTile tile = vulkan::sheet_tile(limits, steps);
            EXPECT_GT(tile.rows, 0u);
            EXPECT_LE((tile.rows + 4 * steps) * (tile.columns + 4 * steps) * 28, bytes);
            EXPECT_LE(tile.invocations, 128u);
        }
    limits.maxComputeSharedMemorySize = 4 << 10;
    EXPECT_EQ(vulkan::sheet_tile(limits, 4).rows, 0u);
}

TEST(SheetDispatches, RefuseANumberOfStepsThatTheyCannotTake)
{
    if (!test::has_vulkan) GTEST_SKIP() << "an emulator of another machine has no Vulkan driver";
    Scene scene;
    scene.add(test::flat_sheet(3, 3));
    SimulationOptions options = test::on(Backend::vulkan);
    for (const unsigned steps : {0u, 5u}) {
        options.gpu_substeps = steps;
        EXPECT_ERROR(Simulation(scene, options), bad_usage, "gpu_substeps is " + std::to_string(steps));
    }
}

}  // namespace
}  // namespace pliant
