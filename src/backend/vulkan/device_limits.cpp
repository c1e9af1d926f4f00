#include "backend/vulkan/device_limits.hpp"

#include <algorithm>
#include <vector>

#include "backend/vulkan/shader_code.hpp"

namespace pliant::vulkan {

LayoutNeeds needs_of(PassLayout layout)
{
    const auto bindings = bindings_of(layout);
    const auto uniforms =
        static_cast<std::uint32_t>(std::count_if(bindings.begin(), bindings.end(), is_uniform));
    return {static_cast<std::uint32_t>(bindings.size()) - uniforms, uniforms};
}

std::string beyond_limits(const vk::PhysicalDeviceLimits& device, const ShaderNeeds& shader,
                          const LayoutNeeds& layout)
{
    const struct {
        const char* name;
        std::uint64_t offered, needed;
    } limits[] = {
        {"maxPerStageDescriptorStorageBuffers", device.maxPerStageDescriptorStorageBuffers,
         layout.storage_buffers},
        {"maxDescriptorSetStorageBuffers", device.maxDescriptorSetStorageBuffers, layout.storage_buffers},
        {"maxPerStageDescriptorUniformBuffers", device.maxPerStageDescriptorUniformBuffers,
         layout.uniform_buffers},
        {"maxDescriptorSetUniformBuffers", device.maxDescriptorSetUniformBuffers, layout.uniform_buffers},
        {"maxPerStageResources", device.maxPerStageResources,
         layout.storage_buffers + layout.uniform_buffers},
        {"maxComputeWorkGroupSize[0]", device.maxComputeWorkGroupSize[0], shader.group_size[0]},
        {"maxComputeWorkGroupSize[1]", device.maxComputeWorkGroupSize[1], shader.group_size[1]},
        {"maxComputeWorkGroupSize[2]", device.maxComputeWorkGroupSize[2], shader.group_size[2]},
        {"maxComputeWorkGroupInvocations", device.maxComputeWorkGroupInvocations, shader.invocations()},
        {"maxComputeSharedMemorySize", device.maxComputeSharedMemorySize, shader.shared_memory},
        {"maxPushConstantsSize", device.maxPushConstantsSize, shader.push_constants},
        {"maxUniformBufferRange", device.maxUniformBufferRange, shader.uniform_range},
    };
    for (const auto& limit : limits)
        if (limit.offered < limit.needed)
            return std::string("its limit ") + limit.name + " is " + std::to_string(limit.offered) +
                   ", and " + std::to_string(limit.needed) + " is needed";
    return {};
}

std::string passes_beyond_limits(const vk::PhysicalDeviceLimits& device)
{
    static const std::vector<ShaderNeeds> needs = [] {
        std::vector<ShaderNeeds> of_passes;
        for (std::uint32_t p = 0; p < all_passes().size(); ++p)
            of_passes.push_back(needs_of(compute_shader(static_cast<Pass>(p))));
        return of_passes;
    }();
    for (std::uint32_t p = 0; p < needs.size(); ++p) {
        const std::string beyond = beyond_limits(device, needs[p], needs_of(layout_of(static_cast<Pass>(p))));
        if (!beyond.empty()) return std::string("the pass ") + all_passes()[p].name + ": " + beyond;
    }
    return {};
}

}  // namespace pliant::vulkan
