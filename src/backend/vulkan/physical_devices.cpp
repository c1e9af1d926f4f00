#include "backend/vulkan/physical_devices.hpp"

#include <algorithm>
#include <cstring>

#include "backend/vulkan/device_limits.hpp"
#include "pliant/error.hpp"

namespace pliant::vulkan {
namespace {

std::string kind_name(vk::PhysicalDeviceType type)
{
    switch (type) {
        case vk::PhysicalDeviceType::eDiscreteGpu: return "discrete GPU";
        case vk::PhysicalDeviceType::eIntegratedGpu: return "integrated GPU";
        case vk::PhysicalDeviceType::eVirtualGpu: return "virtual GPU";
        case vk::PhysicalDeviceType::eCpu: return "software";
        default: return "other";
    }
}

std::string refusal_of(const vk::raii::PhysicalDevice& physical)
{
    const auto properties = physical.getProperties();
    if (properties.apiVersion < least_version)
        return "it has Vulkan " + version_text(properties.apiVersion) + ", and " +
               version_text(least_version) + " is needed";
    if (best_queue_family(physical) < 0) return "it has no compute queue";
    const std::string beyond = passes_beyond_limits(properties.limits);
    return beyond.empty() ? beyond : "it cannot run " + beyond;
}

bool is_among(const auto& extensions, const char* name)
{
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const auto& known) { return std::strcmp(known.extensionName, name) == 0; });
}

/// Lists the devices that are refused, or those that are not.
std::vector<PhysicalDeviceInfo> listed(bool refused) noexcept
{
    std::vector<PhysicalDeviceInfo> result;
    try {
        const vk::raii::Context context;
        const auto instance = make_instance(context, false);
        for (Candidate& candidate : candidates_of(instance))
            if (candidate.info.refusal.empty() != refused) result.push_back(std::move(candidate.info));
    } catch (const std::exception&) {
        result.clear();  // no loader or driver: no devices
    }
    return result;
}

}  // namespace

std::string version_text(std::uint32_t version)
{
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
           std::to_string(VK_API_VERSION_MINOR(version));
}

std::string PhysicalDeviceInfo::promise() const
{
    if (float_controls.flush_denormals && float_controls.round_to_nearest) return equal_bits;
    std::string why;
    if (!float_controls.flush_denormals) why = "it cannot be set to flush denormals (DenormFlushToZero)";
    if (!float_controls.round_to_nearest)
        why += std::string(why.empty() ? "it cannot be set" : ", nor") +
               " to round to nearest (RoundingModeRTE)";
    return "equal bits are not promised: " + why;
}

std::vector<PhysicalDeviceInfo> list_physical_devices() noexcept { return listed(false); }
std::vector<PhysicalDeviceInfo> list_refused_devices() noexcept { return listed(true); }

vk::raii::Instance make_instance(const vk::raii::Context& context, bool validation,
                                 std::vector<const char*> extensions)
{
    std::vector<const char*> layers;
    if (validation) {
        const auto available = context.enumerateInstanceLayerProperties();
        if (std::none_of(available.begin(), available.end(), [](const auto& layer) {
                return std::strcmp(layer.layerName, validation_layer) == 0;
            }))
            throw Error(ErrorKind::device_failure, std::string("the Vulkan layer ") + validation_layer +
                                                       " is not installed: on Debian, install the package "
                                                       "vulkan-validationlayers");
        layers.push_back(validation_layer);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    vk::InstanceCreateFlags flags;
    if (is_among(context.enumerateInstanceExtensionProperties(),
                 VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
        extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
        flags = vk::InstanceCreateFlagBits::eEnumeratePortabilityKHR;
    }
    const vk::ApplicationInfo application("pliant", 1, "pliant", 1, least_version);
    return {context, vk::InstanceCreateInfo(flags, &application, layers, extensions)};
}

bool offers(const vk::raii::PhysicalDevice& physical, const char* extension)
{
    return is_among(physical.enumerateDeviceExtensionProperties(), extension);
}

int best_queue_family(const vk::raii::PhysicalDevice& physical)
{
    const auto families = physical.getQueueFamilyProperties();
    int compute = -1;
    for (std::size_t i = 0; i < families.size(); ++i) {
        const auto flags = families[i].queueFlags;
        if (!(flags & vk::QueueFlagBits::eCompute)) continue;
        if (flags & vk::QueueFlagBits::eGraphics) return static_cast<int>(i);
        if (compute < 0) compute = static_cast<int>(i);
    }
    return compute;
}

PhysicalDeviceInfo describe(const vk::raii::PhysicalDevice& physical)
{
    const auto properties = physical.getProperties();
    PhysicalDeviceInfo info;
    info.name = properties.deviceName.data();
    info.kind = kind_name(properties.deviceType);
    info.hardware = properties.deviceType != vk::PhysicalDeviceType::eCpu;
    info.api_version = properties.apiVersion;
    info.max_buffer_range = properties.limits.maxStorageBufferRange;
    info.max_shared_memory = properties.limits.maxComputeSharedMemorySize;
    const auto memory = physical.getMemoryProperties();
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal)
            info.memory = std::max<std::uint64_t>(info.memory, memory.memoryHeaps[i].size);
    info.refusal = refusal_of(physical);
    if (properties.apiVersion < least_version) return info;  // its other properties need a later version
    using Properties = vk::PhysicalDeviceProperties2;
    using Limits = vk::PhysicalDeviceMaintenance3Properties;
    info.max_allocation = physical.getProperties2<Properties, Limits>().get<Limits>().maxMemoryAllocationSize;
    if (offers(physical, VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME)) {
        using Controls = vk::PhysicalDeviceFloatControlsPropertiesKHR;
        const auto controls = physical.getProperties2<Properties, Controls>().get<Controls>();
        info.float_controls = {controls.shaderDenormFlushToZeroFloat32 == VK_TRUE,
                               controls.shaderRoundingModeRTEFloat32 == VK_TRUE};
    }
    return info;
}

std::vector<Candidate> candidates_of(const vk::raii::Instance& instance)
{
    std::vector<Candidate> candidates;
    int usable = 0;
    for (auto& physical : vk::raii::PhysicalDevices(instance)) {
        PhysicalDeviceInfo info = describe(physical);
        if (info.refusal.empty()) info.index = usable++;
        candidates.push_back({std::move(physical), std::move(info)});
    }
    return candidates;
}

}  // namespace pliant::vulkan
