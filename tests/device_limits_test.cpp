// Requirements of shaders: layouts provide them, no layout exceeds the limits of phones, and a device that
// does not meet them is refused with the limit's name.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "backend/vulkan/device_limits.hpp"
#include "backend/vulkan/layout.hpp"
#include "backend/vulkan/pass_pipelines.hpp"
#include "backend/vulkan/physical_devices.hpp"
#include "backend/vulkan/shader_code.hpp"
#include "backend/vulkan/solver_buffers.hpp"
#include "render/pipelines.hpp"
#include "solve/frame.hpp"
#include "test_cloths.hpp"

namespace pliant {
namespace {

using vulkan::Binding;
using vulkan::ShaderNeeds;

constexpr std::size_t most_storage_buffers = 10;

struct Shader {
    std::string name;
    vulkan::PassLayout layout;
    ShaderNeeds needs;
};

std::vector<Shader> all_shaders()
{
    std::vector<Shader> shaders;
    const auto add = [&](const std::string& name, Pass pass, std::span<const std::uint32_t> code) {
        if (!code.empty()) shaders.push_back({name, vulkan::layout_of(pass), vulkan::needs_of(code)});
    };
    for (std::uint32_t p = 0; p < all_passes().size(); ++p) {
        const auto pass = static_cast<Pass>(p);
        add(all_passes()[p].name, pass, vulkan::compute_shader(pass));
        add(all_passes()[p].name + std::string(", fast"), pass, vulkan::fast_compute_shader(pass));
    }
    add("sheet_steps", Pass::sheet_step, vulkan::sheet_steps_shader());
    add("sheet_steps, fast", Pass::sheet_step, vulkan::fast_sheet_steps_shader());
    return shaders;
}

TEST(Layouts, HaveEveryBufferThatTheirShadersUse)
{
    std::set<std::uint32_t> seen;
    for (const Shader& shader : all_shaders()) {
        std::set<std::uint32_t> storage, uniform;
        for (const Binding binding : vulkan::bindings_of(shader.layout))
            (vulkan::is_uniform(binding) ? uniform : storage).insert(static_cast<std::uint32_t>(binding));
        for (const std::uint32_t binding : shader.needs.storage_buffers)
            EXPECT_TRUE(storage.count(binding) > 0)
                << shader.name << " uses storage buffer " << binding << ", which its layout lacks";
        for (const std::uint32_t binding : shader.needs.uniform_buffers)
            EXPECT_TRUE(uniform.count(binding) > 0)
                << shader.name << " uses uniform buffer " << binding << ", which its layout lacks";
        EXPECT_FALSE(shader.needs.storage_buffers.empty()) << shader.name;
        seen.insert(shader.needs.storage_buffers.begin(), shader.needs.storage_buffers.end());
    }
    EXPECT_EQ(seen.size(), 28u);  // every binding is used
}

TEST(Layouts, HaveNothingThatNoShaderOfTheirsUses)
{
    for (std::uint32_t f = 0; f < vulkan::layout_count; ++f) {
        std::set<std::uint32_t> used;
        for (const Shader& shader : all_shaders()) {
            if (shader.layout != static_cast<vulkan::PassLayout>(f)) continue;
            used.insert(shader.needs.storage_buffers.begin(), shader.needs.storage_buffers.end());
            used.insert(shader.needs.uniform_buffers.begin(), shader.needs.uniform_buffers.end());
        }
        for (const Binding binding : vulkan::bindings_of(static_cast<vulkan::PassLayout>(f)))
            EXPECT_TRUE(used.count(static_cast<std::uint32_t>(binding)) > 0)
                << "layout " << f << " binds " << static_cast<std::uint32_t>(binding);
    }
}

TEST(Layouts, HaveAtMostTenStorageBuffersEach)
{
    for (std::uint32_t f = 0; f < vulkan::layout_count; ++f) {
        const auto layout = static_cast<vulkan::PassLayout>(f);
        EXPECT_GT(vulkan::bindings_of(layout).size(), 0u);
        EXPECT_LE(vulkan::needs_of(layout).storage_buffers, most_storage_buffers) << "layout " << f;
    }
    for (const Shader& shader : all_shaders())
        EXPECT_LE(shader.needs.storage_buffers.size(), most_storage_buffers) << shader.name;
}

TEST(Layouts, OfPicturesHaveEveryBufferThatTheirShadersUse)
{
    std::size_t with_buffers = 0;
    for (const vulkan::PictureShader& shader : vulkan::picture_shaders()) {
        const std::set<std::uint32_t> bound(shader.cloth_bindings.begin(), shader.cloth_bindings.end());
        EXPECT_LE(bound.size(), most_storage_buffers) << shader.name;
        const ShaderNeeds needs = vulkan::needs_of(shader.code);
        with_buffers += needs.storage_buffers.empty() ? 0 : 1;
        for (const std::uint32_t binding : needs.storage_buffers)
            EXPECT_TRUE(bound.count(binding) > 0)
                << shader.name << " uses storage buffer " << binding << ", which its layout lacks";
    }
    EXPECT_EQ(
        with_buffers,
        7u);  // of the cloth: its surface, shadow, picture, outlines; of shapes: outlines; lines, points
}

TEST(ShaderNeeds, AreThoseOfTheText)
{
    const ShaderNeeds measure = vulkan::needs_of(vulkan::compute_shader(Pass::sheet_measure));
    EXPECT_EQ(measure.storage_buffers, (std::vector<std::uint32_t>{1, 2, 6, 17}));
    EXPECT_EQ(measure.uniform_buffers, (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(measure.invocations(), 256u);
    EXPECT_EQ(measure.shared_memory, 256u * 8 * 4);  // of shaders/measure.glsl

    const ShaderNeeds step = vulkan::needs_of(vulkan::compute_shader(Pass::sheet_step));
    EXPECT_EQ(step.group_size, (std::array<std::uint32_t, 3>{32, 4, 1}));
    EXPECT_EQ(step.shared_memory, 0u);
    EXPECT_EQ(step.push_constants, sizeof(vulkan::Push));

    // The uniform block of shaders/solver.glsl, by the rules of std140.
    const ShaderNeeds smooth = vulkan::needs_of(vulkan::compute_shader(Pass::level_smooth));
    EXPECT_EQ(smooth.uniform_buffers.back(), static_cast<std::uint32_t>(Binding::solver));
    EXPECT_EQ(smooth.uniform_range, 23u * 16 + 32 * 6 * 16);

    // Sizes that are set when a pipeline is made: tiles of 8 x 16 nodes, and 4 more on each side for 2 steps.
    const std::vector<std::uint32_t> constants{96, 2, 8, 16};
    const ShaderNeeds steps = vulkan::needs_of(vulkan::sheet_steps_shader(), constants);
    EXPECT_EQ(steps.group_size, (std::array<std::uint32_t, 3>{96, 1, 1}));
    EXPECT_EQ(steps.shared_memory, 7u * (8 + 8) * (16 + 8) * 4);
}

/// The exact limits that the passes need.
vk::PhysicalDeviceLimits tight_limits()
{
    vk::PhysicalDeviceLimits limits;
    limits.maxPerStageDescriptorStorageBuffers = limits.maxDescriptorSetStorageBuffers = 10;
    limits.maxPerStageDescriptorUniformBuffers = limits.maxDescriptorSetUniformBuffers = 2;
    limits.maxPerStageResources = 12;
    limits.maxComputeWorkGroupSize = std::array<std::uint32_t, 3>{256, 4, 1};
    limits.maxComputeWorkGroupInvocations = 256;
    limits.maxComputeSharedMemorySize = (256 + 16) * 48;  // of shaders/body_sums.glsl
    limits.maxPushConstantsSize = 36;
    limits.maxUniformBufferRange = 3440;
    return limits;
}

TEST(DeviceLimits, AreNamedWithWhatThereIsAndWhatIsNeeded)
{
    EXPECT_EQ(vulkan::passes_beyond_limits(tight_limits()), "");
    using Limits = vk::PhysicalDeviceLimits;
    const struct {
        const char* name;
        std::uint32_t& (*of)(Limits&);
        const char* needed;
    } cases[] = {
        {"maxPerStageDescriptorStorageBuffers",
         [](Limits& l) -> std::uint32_t& { return l.maxPerStageDescriptorStorageBuffers; }, "10"},
        {"maxDescriptorSetStorageBuffers",
         [](Limits& l) -> std::uint32_t& { return l.maxDescriptorSetStorageBuffers; }, "10"},
        {"maxPerStageDescriptorUniformBuffers",
         [](Limits& l) -> std::uint32_t& { return l.maxPerStageDescriptorUniformBuffers; }, "2"},
        {"maxDescriptorSetUniformBuffers",
         [](Limits& l) -> std::uint32_t& { return l.maxDescriptorSetUniformBuffers; }, "2"},
        {"maxPerStageResources", [](Limits& l) -> std::uint32_t& { return l.maxPerStageResources; }, "12"},
        {"maxComputeWorkGroupSize[0]",
         [](Limits& l) -> std::uint32_t& { return l.maxComputeWorkGroupSize[0]; }, "256"},
        {"maxComputeWorkGroupSize[1]",
         [](Limits& l) -> std::uint32_t& { return l.maxComputeWorkGroupSize[1]; }, "4"},
        {"maxComputeWorkGroupSize[2]",
         [](Limits& l) -> std::uint32_t& { return l.maxComputeWorkGroupSize[2]; }, "1"},
        {"maxComputeWorkGroupInvocations",
         [](Limits& l) -> std::uint32_t& { return l.maxComputeWorkGroupInvocations; }, "256"},
        {"maxComputeSharedMemorySize",
         [](Limits& l) -> std::uint32_t& { return l.maxComputeSharedMemorySize; }, "13056"},
        {"maxPushConstantsSize", [](Limits& l) -> std::uint32_t& { return l.maxPushConstantsSize; }, "36"},
        {"maxUniformBufferRange", [](Limits& l) -> std::uint32_t& { return l.maxUniformBufferRange; },
         "3440"},
    };
    for (const auto& one : cases) {
        Limits limits = tight_limits();
        const std::uint32_t offered = --one.of(limits);
        const std::string beyond = vulkan::passes_beyond_limits(limits);
        EXPECT_TRUE(beyond.starts_with("the pass ")) << one.name << ": " << beyond;
        EXPECT_TRUE(beyond.ends_with(std::string("its limit ") + one.name + " is " + std::to_string(offered) +
                                     ", and " + one.needed + " is needed"))
            << one.name << ": " << beyond;
    }
}

TEST(DeviceLimits, SayWhetherBitsAreEqual)
{
    vulkan::PhysicalDeviceInfo info;
    info.float_controls = {true, true};
    EXPECT_EQ(info.promise(), vulkan::equal_bits);
    info.float_controls = {false, true};
    EXPECT_NE(info.promise().find("flush denormals"), std::string::npos);
    EXPECT_EQ(info.promise().find("round to nearest"), std::string::npos);
    info.float_controls = {true, false};
    EXPECT_EQ(info.promise().find("flush denormals"), std::string::npos);
    EXPECT_NE(info.promise().find("round to nearest"), std::string::npos);
    info.float_controls = {false, false};
    EXPECT_NE(info.promise().find("flush denormals"), std::string::npos);
    EXPECT_NE(info.promise().find("round to nearest"), std::string::npos);
}

ClothModel solved_sheet(double nodes)
{
    Scene scene;
    scene.method = Method::constraint;
    const auto side = static_cast<std::uint32_t>(std::lround(std::sqrt(nodes)));
    scene.add(test::flat_sheet(side, side));
    return ClothModel(scene.cloth(0), scene);
}

TEST(DeviceLimits, SayHowManyNodesOfASolverFit)
{
    constexpr std::uint64_t most = 64u << 20;  // bytes
    const std::string refusal = vulkan::arena_refusal(solved_sheet(600 * 600), "a device", most);
    std::smatch number;
    ASSERT_TRUE(std::regex_search(refusal, number, std::regex("about ([0-9]+) nodes of this kind")))
        << refusal;
    EXPECT_NE(refusal.find("on a device the limit maxStorageBufferRange is 67108864"), std::string::npos)
        << refusal;
    const double fit = std::stod(number[1]);
    EXPECT_EQ(vulkan::arena_refusal(solved_sheet(0.9 * fit), "a device", most), "");
    EXPECT_NE(vulkan::arena_refusal(solved_sheet(1.05 * fit), "a device", most), "");
}

TEST(Pipelines, AreMadeOnlyWhereAProgramNamesThem)
{
    SimulationOptions options = test::on(Backend::vulkan);
    options.shared_device = std::make_shared<vulkan::Device>(vulkan::DeviceOptions{.validation = true});
    Scene scene;
    scene.add(test::flat_sheet(9, 7));
    const auto made = vulkan::PassPipelines::of(*options.shared_device, false);
    EXPECT_EQ(made->made_count(), 0u);
    Simulation simulation(scene, options);
    simulation.advance(1.0 / 60);
    EXPECT_EQ(made->made_count(), 2u);  // sheet_step and sheet_measure: 63 nodes are one block
    simulation.normals(0);
    EXPECT_EQ(made->made_count(), 4u);  // and what is drawn: normals and strains
    simulation.grab(0, 3, {0, 1, 0}, 10, 0);
    simulation.advance(1.0 / 60);
    EXPECT_EQ(made->made_count(), 5u);
    EXPECT_EQ(simulation.report().failure, "");
}

}  // namespace
}  // namespace pliant
