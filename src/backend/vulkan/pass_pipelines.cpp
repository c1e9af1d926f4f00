#include "backend/vulkan/pass_pipelines.hpp"

#include <algorithm>

#include "backend/vulkan/cloth_buffers.hpp"
#include "backend/vulkan/shader_code.hpp"

namespace pliant::vulkan {
namespace {

/// All cloths of a scene do, or none: by the scene's method.
bool needs_solver(const ClothModel& model) { return !model.hierarchy.empty(); }

}  // namespace

PassPipelines::PassPipelines(const Device& device, bool fast_math)
    : sets(make_cloth_layout(device)), fast_math_(fast_math)
{
    const vk::PushConstantRange push(vk::ShaderStageFlagBits::eCompute, 0, sizeof(Push));
    const vk::DescriptorSetLayout of_sets = *sets;
    layout = {device.handle(), vk::PipelineLayoutCreateInfo({}, of_sets, push)};
    for (std::size_t p = 0; p < all_passes().size(); ++p) pipelines_.emplace_back(nullptr);
}

std::shared_ptr<PassPipelines> PassPipelines::of(const Device& device, bool fast_math)
{
    std::shared_ptr<void>& kept = device.kept(fast_math ? "fast pass pipelines" : "pass pipelines");
    if (!kept) kept = std::make_shared<PassPipelines>(device, fast_math);
    return std::static_pointer_cast<PassPipelines>(kept);
}

void PassPipelines::make(const Device& device, std::span<const ClothModel> models)
{
    const bool solved = std::any_of(models.begin(), models.end(), needs_solver);
    const bool bodies =
        std::any_of(models.begin(), models.end(), [](const ClothModel& model) { return model.is_body(); });
    for (std::uint32_t p = 0; p < pipelines_.size(); ++p) {
        const auto pass = static_cast<Pass>(p);
        if (*pipelines_[p] || (is_solver_pass(pass) && !solved) || (is_body_pass(pass) && !bodies)) continue;
        const auto fast = fast_math_ ? fast_compute_shader(pass) : std::span<const std::uint32_t>();
        pipelines_[p] =
            fast.empty() ? made(device, with_exact_arithmetic(compute_shader(pass))) : made(device, fast);
    }
    device.pipelines().keep();
}

std::uint32_t PassPipelines::make_sheet_steps(const Device& device, std::uint32_t most)
{
    const vk::PhysicalDeviceLimits limits = device.physical().getProperties().limits;
    while (most > 1 && sheet_tile(limits, most).rows == 0) --most;
    for (std::uint32_t steps = 2; steps <= most; ++steps) {
        SheetSteps& of = sheet_steps_[steps];
        if (*of.pipeline) continue;
        of.tile = sheet_tile(limits, steps);
        const std::array constants{of.tile.invocations, steps, of.tile.rows, of.tile.columns};
        of.pipeline = fast_math_ ? made(device, fast_sheet_steps_shader(), constants)
                                 : made(device, with_exact_arithmetic(sheet_steps_shader()), constants);
    }
    device.pipelines().keep();
    return most;
}

vk::raii::Pipeline PassPipelines::made(const Device& device, std::span<const std::uint32_t> code,
                                       std::span<const std::uint32_t> constants) const
{
    const auto properties =
        device.physical()
            .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceFloatControlsProperties>();
    const auto& controls = properties.get<vk::PhysicalDeviceFloatControlsProperties>();
    const FloatControls modes{controls.shaderDenormFlushToZeroFloat32 == VK_TRUE,
                              controls.shaderRoundingModeRTEFloat32 == VK_TRUE};
    std::vector<vk::SpecializationMapEntry> entries;
    for (std::uint32_t k = 0; k < constants.size(); ++k)
        entries.emplace_back(k, k * sizeof constants[k], sizeof constants[k]);
    const vk::SpecializationInfo specialised(static_cast<std::uint32_t>(entries.size()), entries.data(),
                                             constants.size_bytes(), constants.data());
    const auto module = device.make_shader(with_float_controls(code, modes));
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main",
                                                  &specialised);
    return {device.handle(), device.pipelines().cache(), vk::ComputePipelineCreateInfo({}, stage, *layout)};
}

}  // namespace pliant::vulkan
