// Steps of a sheet that the CPU takes in one pass over its rows, against the same steps in a pass each: the
// same operations in the same order at every node, so the same bits.
#include <gtest/gtest.h>

#include <map>

#include "backend/cpu/kernels.hpp"
#include "backend/cpu/sheet_steps.hpp"
#include "solve/frame.hpp"
#include "test_bits.hpp"
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

/// After a frame's steps, `at_once` of them in a program; measures after the last.
State state_after(const ClothModel& model, const SimulationOptions& options, std::uint32_t at_once)
{
    const auto runner = make_cpu_runner({&model, 1}, options);
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
    SimulationOptions options;
    options.threads = 1;
    const State expected = state_after(model, options, 1);
    for (const cpu::Kernels* kernels : cpu::available_kernels())
        for (const unsigned threads : {1u, 2u, 3u, 7u}) {
            options.threads = threads;
            options.instruction_set = kernels->name;
            test::expect_same_bits(expected, state_after(model, options, frame_steps),
                                   std::string(kernels->name) + ", " + std::to_string(threads) + " threads");
        }
}

// Rows around what steps and parts need; columns around packs of 4, 8, 16 and chunks of 128.
INSTANTIATE_TEST_SUITE_P(Sizes, SheetSteps,
                         testing::Values(Size{2, 2}, Size{3, 131}, Size{31, 2}, Size{33, 129}, Size{65, 256},
                                         Size{131, 7}, Size{600, 33}),
                         [](const auto& param) {
                             return std::to_string(param.param.rows) + "x" +
                                    std::to_string(param.param.columns);
                         });

TEST(SheetSteps, AreTakenSeveralAtOnceWhereThePartsAreTallEnough)
{
    EXPECT_EQ(cpu::SheetSteps::most_steps(2, 1), cpu::SheetStretch::most_steps);
    EXPECT_EQ(cpu::SheetSteps::most_steps(31, 2), 1u);
    EXPECT_GE(cpu::SheetSteps::most_steps(600, 3), 2u);  // of the sizes above, with gaps to fill
    EXPECT_EQ(cpu::SheetSteps::most_steps(2796, 2), cpu::SheetStretch::most_steps);
}

}  // namespace
}  // namespace pliant
