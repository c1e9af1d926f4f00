#include "backend/vulkan/pass_pipelines.hpp"

#include <algorithm>

#include "backend/vulkan/cloth_buffers.hpp"
#include "backend/vulkan/device_limits.hpp"
#include "backend/vulkan/layout.hpp"
#include "backend/vulkan/shader_code.hpp"
#include "pliant/error.hpp"

namespace pliant::vulkan {

PassPipelines::PassPipelines(const Device& device, bool fast_math) : fast_math_(fast_math)
{
    const vk::PushConstantRange push(vk::ShaderStageFlagBits::eCompute, 0, sizeof(Push));
    for (std::uint32_t f = 0; f < layout_count; ++f) {
        sets_.push_back(make_cloth_layout(device, static_cast<PassLayout>(f)));
        const vk::DescriptorSetLayout set = *sets_.back();
        layouts_.emplace_back(device.handle(), vk::PipelineLayoutCreateInfo({}, set, push));
    }
    const vk::PhysicalDeviceLimits limits = device.physical().getProperties().limits;
    for (std::uint32_t steps = 2; steps < tiles_.size(); ++steps) tiles_[steps] = sheet_tile(limits, steps);
    for (std::size_t p = 0; p < all_passes().size() + tiles_.size(); ++p) pipelines_.emplace_back(nullptr);
}

std::shared_ptr<PassPipelines> PassPipelines::of(const Device& device, bool fast_math)
{
    std::shared_ptr<void>& kept = device.kept(fast_math ? "fast pass pipelines" : "pass pipelines");
    if (!kept) kept = std::make_shared<PassPipelines>(device, fast_math);
    return std::static_pointer_cast<PassPipelines>(kept);
}

std::size_t PassPipelines::place_of(const Dispatch& dispatch)
{
    return dispatch.steps > 1 ? all_passes().size() + dispatch.steps
                              : static_cast<std::size_t>(dispatch.call.pass);
}

void PassPipelines::make(const Device& device, std::span<const Dispatch> dispatches)
{
    const std::scoped_lock turn(turn_);
    bool any = false;
    for (const Dispatch& dispatch : dispatches) {
        vk::raii::Pipeline& pipeline = pipelines_[place_of(dispatch)];
        if (*pipeline) continue;
        pipeline = made(device, dispatch);
        any = true;
    }
    if (any) device.pipelines().keep();
}

std::size_t PassPipelines::made_count() const
{
    const std::scoped_lock turn(turn_);
    return static_cast<std::size_t>(std::count_if(
        pipelines_.begin(), pipelines_.end(), [](const vk::raii::Pipeline& pipeline) { return *pipeline; }));
}

vk::Pipeline PassPipelines::of(const Dispatch& dispatch) const
{
    const std::scoped_lock turn(turn_);
    return *pipelines_[place_of(dispatch)];
}

std::uint32_t PassPipelines::sheet_steps(std::uint32_t most) const
{
    while (most > 1 && tiles_[most].rows == 0) --most;
    return most;
}

vk::raii::Pipeline PassPipelines::made(const Device& device, const Dispatch& dispatch) const
{
    const Pass pass = dispatch.call.pass;
    std::vector<std::uint32_t> constants;  // values of the shader's constants 0, 1, ...
    std::span<const std::uint32_t> exact = compute_shader(pass), code;
    if (fast_math_) code = fast_compute_shader(pass);
    if (dispatch.steps > 1) {
        const SheetTile& tile = tiles_[dispatch.steps];
        constants = {tile.invocations, dispatch.steps, tile.rows, tile.columns};
        exact = sheet_steps_shader();
        if (fast_math_) code = fast_sheet_steps_shader();
    }
    std::vector<std::uint32_t> decorated;
    if (code.empty()) code = decorated = with_exact_arithmetic(exact);

    const PassLayout layout = layout_of(pass);
    const std::string beyond =
        beyond_limits(device.physical().getProperties().limits, needs_of(code, constants), needs_of(layout));
    if (!beyond.empty())
        throw Error(ErrorKind::device_failure,
                    "the Vulkan device " + device.info().name + " cannot run the pass " +
                        description_of(pass).name + ": " + beyond +
                        "; choose another with --device, or run with --backend cpu");
    std::vector<vk::SpecializationMapEntry> entries;
    for (std::uint32_t k = 0; k < constants.size(); ++k)
        entries.emplace_back(k, k * sizeof constants[k], sizeof constants[k]);
    const vk::SpecializationInfo specialised(static_cast<std::uint32_t>(entries.size()), entries.data(),
                                             constants.size() * sizeof constants[0], constants.data());
    const auto module = device.make_shader(with_float_controls(code, device.info().float_controls));
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main",
                                                  &specialised);
    return {device.handle(), device.pipelines().cache(),
            vk::ComputePipelineCreateInfo({}, stage, this->layout(layout))};
}

}  // namespace pliant::vulkan
