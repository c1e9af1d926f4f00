// A Vulkan layer that makes the device below it report the limits, version, extensions and features of
// another one (devices.cpp), chosen by the environment variable PLIANT_TEST_DEVICE. The validation layer
// belongs above it: it then sees the limits that are reported here, and says what exceeds them. What it
// cannot see, this layer says itself, by the same messengers: extensions and features that are not reported,
// and Metal's places for buffers.
#define VK_ENABLE_BETA_EXTENSIONS  // the portability subset
#include <vulkan/vulkan.h>
// After it, which it needs.
#include <vulkan/vk_layer.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <vector>

#include "devices.hpp"

namespace pliant::limits {
namespace {

constexpr const char* layer_name = "VK_LAYER_PLIANT_limits";

/// Of the environment when the latest instance was made.
const TestDevice* chosen = nullptr;
const TestDevice& test_device() { return *chosen; }

bool choose_device()
{
    const char* name = std::getenv("PLIANT_TEST_DEVICE");
    chosen = find_test_device(name ? name : "");
    if (!chosen)
        std::fprintf(stderr, "%s: PLIANT_TEST_DEVICE names no device: '%s'\n", layer_name, name ? name : "");
    return chosen;
}

/// What lies below an instance. The functions are asked for when it is made: later the loader would answer
/// with the uppermost layer's.
struct Instance {
    VkInstance handle = nullptr;
    PFN_vkGetInstanceProcAddr next = nullptr;
    PFN_vkDestroyInstance destroy = nullptr;
    PFN_vkGetPhysicalDeviceProperties properties = nullptr;
    PFN_vkGetPhysicalDeviceProperties2 properties2 = nullptr;
    PFN_vkGetPhysicalDeviceFeatures features = nullptr;
    PFN_vkGetPhysicalDeviceFeatures2 features2 = nullptr;
    PFN_vkEnumerateDeviceExtensionProperties extensions = nullptr;
    PFN_vkSubmitDebugUtilsMessageEXT submit_message = nullptr;  ///< null without messengers
};

/// Buffers of a set of descriptors, by stage.
using BuffersOfStages = std::map<VkShaderStageFlagBits, std::uint32_t>;

struct Device {
    VkDevice handle = nullptr;
    PFN_vkGetDeviceProcAddr next = nullptr;
    const Instance* instance = nullptr;
    std::map<VkDescriptorSetLayout, BuffersOfStages> set_layouts;
    std::atomic<std::uint32_t> allocations{0};

    template <class Function>
    Function get(const char* name) const
    {
        return reinterpret_cast<Function>(next(handle, name));
    }
};

// The loader puts a pointer at the beginning of what is dispatched: the same for an instance and its physical
// devices, and for a device with its queues and commands.
using Key = const void*;
template <class Handle>
Key key_of(Handle handle)
{
    return *reinterpret_cast<const Key*>(handle);
}

std::mutex turn;
std::map<Key, std::unique_ptr<Instance>> instances;
std::map<Key, std::unique_ptr<Device>> devices;

template <class Handle>
Instance& instance_of(Handle handle)
{
    const std::scoped_lock lock(turn);
    return *instances.at(key_of(handle));
}

Device& device_of(VkDevice handle)
{
    const std::scoped_lock lock(turn);
    return *devices.at(key_of(handle));
}

/// What a person reads of a refusal.
std::string sentence(const std::string& what)
{
    return std::string("limits of ") + test_device().name + ": " + what;
}

/// To the messengers of the instance, or where there are none to the terminal. Not while the loader makes an
/// instance or a device: it then holds a lock that its messengers want.
void complain(const Instance& instance, const std::string& what)
{
    const std::string message = sentence(what);
    if (!instance.submit_message) {
        std::fprintf(stderr, "%s\n", message.c_str());
        return;
    }
    VkDebugUtilsMessengerCallbackDataEXT data{};
    data.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CALLBACK_DATA_EXT;
    data.pMessageIdName = layer_name;
    data.pMessage = message.c_str();
    instance.submit_message(instance.handle, VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
                            VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT, &data);
}

VkResult refuse(VkResult result, const std::string& why)
{
    std::fprintf(stderr, "%s\n", sentence(why).c_str());
    return result;
}

/// A structure of a chain by its type; null when it is not there.
template <class Structure>
Structure* in_chain(void* next, VkStructureType type)
{
    for (auto* at = static_cast<VkBaseOutStructure*>(next); at; at = at->pNext)
        if (at->sType == type) return reinterpret_cast<Structure*>(at);
    return nullptr;
}

/// A driver leaves alone what it does not know: keeps a structure as it is, until the end of the scope.
template <class Structure>
class Untouched {
public:
    Untouched(void* chain, VkStructureType type, bool wanted)
        : at_(wanted ? in_chain<Structure>(chain, type) : nullptr)
    {
        if (at_) before_ = *at_;
    }
    Untouched(const Untouched&) = delete;
    Untouched& operator=(const Untouched&) = delete;
    ~Untouched()
    {
        if (at_) *at_ = before_;
    }

private:
    Structure* at_;
    Structure before_{};
};

// --- what is reported
// --------------------------------------------------------------------------------------------

/// Never more than the device below has.
void limit(std::uint32_t& reported, std::uint32_t to) { reported = std::min(reported, to); }

void report(VkPhysicalDeviceProperties& properties)
{
    const TestDevice& device = test_device();
    VkPhysicalDeviceLimits& limits = properties.limits;
    limit(properties.apiVersion, device.api_version);
    properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU;
    const std::string name = std::string(device.name) + " over " + properties.deviceName;
    std::snprintf(properties.deviceName, sizeof properties.deviceName, "%s", name.c_str());
    limit(limits.maxPerStageDescriptorStorageBuffers, device.stage_storage_buffers);
    limit(limits.maxDescriptorSetStorageBuffers, device.set_storage_buffers);
    limit(limits.maxPerStageResources, device.stage_resources);
    limit(limits.maxStorageBufferRange, device.storage_range);
    limits.minStorageBufferOffsetAlignment =
        std::max<VkDeviceSize>(limits.minStorageBufferOffsetAlignment, device.storage_alignment);
    limit(limits.maxPushConstantsSize, device.push_constants);
    limit(limits.maxMemoryAllocationCount, device.allocations);
    limit(limits.maxComputeSharedMemorySize, device.shared_memory);
    limit(limits.maxComputeWorkGroupInvocations, device.invocations);
    for (int axis = 0; axis < 3; ++axis) {
        limit(limits.maxComputeWorkGroupSize[axis], device.group_size[axis]);
        limit(limits.maxComputeWorkGroupCount[axis], device.group_count[axis]);
    }
}

/// Of the structures that hold it, that of the extension and that of Vulkan 1.2.
template <class Structure>
void report_float_controls(Structure& properties)
{
    const FloatControls& floats = test_device().floats;
    properties.shaderDenormFlushToZeroFloat32 = floats.flush_denormals ? VK_TRUE : VK_FALSE;
    properties.shaderDenormPreserveFloat32 = VK_FALSE;
    properties.shaderRoundingModeRTEFloat32 = floats.round_to_nearest ? VK_TRUE : VK_FALSE;
}

/// Only what Vulkan requires, and what the table has.
VkPhysicalDeviceFeatures reported_features(const VkPhysicalDeviceFeatures& below)
{
    VkPhysicalDeviceFeatures features{};
    features.robustBufferAccess = below.robustBufferAccess;
    features.fillModeNonSolid = test_device().wires ? below.fillModeNonSolid : VK_FALSE;
    return features;
}

bool is_reported(const char* extension)
{
    const auto is = [&](const char* name) { return std::strcmp(extension, name) == 0; };
    return is(VK_KHR_SWAPCHAIN_EXTENSION_NAME) ||
           (is(VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME) && test_device().floats.offered) ||
           (is(VK_KHR_PORTABILITY_SUBSET_EXTENSION_NAME) && test_device().portability);
}

VKAPI_ATTR void VKAPI_CALL get_properties(VkPhysicalDevice physical, VkPhysicalDeviceProperties* properties)
{
    instance_of(physical).properties(physical, properties);
    report(*properties);
}

VKAPI_ATTR void VKAPI_CALL get_properties2(VkPhysicalDevice physical, VkPhysicalDeviceProperties2* properties)
{
    const auto type_of_floats = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES;
    const auto type_of_12 = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES;
    const std::uint32_t version = test_device().api_version;
    {
        const Untouched<VkPhysicalDeviceVulkan11Properties> of_11(
            properties->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES,
            version < VK_API_VERSION_1_2);
        const Untouched<VkPhysicalDeviceVulkan12Properties> of_12(properties->pNext, type_of_12,
                                                                  version < VK_API_VERSION_1_2);
        const Untouched<VkPhysicalDeviceVulkan13Properties> of_13(
            properties->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES,
            version < VK_API_VERSION_1_3);
        const Untouched<VkPhysicalDeviceFloatControlsProperties> of_floats(properties->pNext, type_of_floats,
                                                                           !test_device().floats.offered);
        instance_of(physical).properties2(physical, properties);
    }
    report(properties->properties);
    if (auto* floats = in_chain<VkPhysicalDeviceFloatControlsProperties>(properties->pNext, type_of_floats);
        floats && test_device().floats.offered)
        report_float_controls(*floats);
    if (auto* of_12 = in_chain<VkPhysicalDeviceVulkan12Properties>(properties->pNext, type_of_12);
        of_12 && version >= VK_API_VERSION_1_2)
        report_float_controls(*of_12);
}

VKAPI_ATTR void VKAPI_CALL get_features(VkPhysicalDevice physical, VkPhysicalDeviceFeatures* features)
{
    instance_of(physical).features(physical, features);
    *features = reported_features(*features);
}

VKAPI_ATTR void VKAPI_CALL get_features2(VkPhysicalDevice physical, VkPhysicalDeviceFeatures2* features)
{
    const std::uint32_t version = test_device().api_version;
    {
        const Untouched<VkPhysicalDeviceVulkan11Features> of_11(
            features->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES,
            version < VK_API_VERSION_1_2);
        const Untouched<VkPhysicalDeviceVulkan12Features> of_12(
            features->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
            version < VK_API_VERSION_1_2);
        const Untouched<VkPhysicalDeviceVulkan13Features> of_13(
            features->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
            version < VK_API_VERSION_1_3);
        instance_of(physical).features2(physical, features);
    }
    features->features = reported_features(features->features);
    auto* subset = in_chain<VkPhysicalDevicePortabilitySubsetFeaturesKHR>(
        features->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PORTABILITY_SUBSET_FEATURES_KHR);
    if (subset && test_device().portability) {  // none of it: what a picture needs must do without
        VkPhysicalDevicePortabilitySubsetFeaturesKHR none{};
        none.sType = subset->sType;
        none.pNext = subset->pNext;
        *subset = none;
    }
}

VKAPI_ATTR VkResult VKAPI_CALL list_extensions(VkPhysicalDevice physical, const char* layer,
                                               std::uint32_t* count, VkExtensionProperties* properties)
{
    if (layer && std::strcmp(layer, layer_name) == 0) {
        *count = 0;
        return VK_SUCCESS;
    }
    const auto below = instance_of(physical).extensions;
    if (layer) return below(physical, layer, count, properties);
    std::uint32_t all = 0;
    if (const VkResult result = below(physical, nullptr, &all, nullptr); result != VK_SUCCESS) return result;
    std::vector<VkExtensionProperties> list(all);
    if (const VkResult result = below(physical, nullptr, &all, list.data()); result != VK_SUCCESS)
        return result;
    list.resize(all);
    const char* added[] = {VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME,
                           VK_KHR_PORTABILITY_SUBSET_EXTENSION_NAME};
    for (const char* name : added)
        if (is_reported(name) && std::none_of(list.begin(), list.end(), [&](const auto& e) {
                return std::strcmp(e.extensionName, name) == 0;
            })) {
            VkExtensionProperties extension{};
            std::snprintf(extension.extensionName, sizeof extension.extensionName, "%s", name);
            extension.specVersion = 1;
            list.push_back(extension);
        }
    list.erase(std::remove_if(list.begin(), list.end(),
                              [](const auto& extension) { return !is_reported(extension.extensionName); }),
               list.end());
    if (!properties) {
        *count = static_cast<std::uint32_t>(list.size());
        return VK_SUCCESS;
    }
    const bool fits = *count >= list.size();
    *count = std::min(*count, static_cast<std::uint32_t>(list.size()));
    std::copy_n(list.begin(), *count, properties);
    return fits ? VK_SUCCESS : VK_INCOMPLETE;
}

// --- what is refused, or complained of
// -----------------------------------------------------------------------------

template <class LinkInfo>
LinkInfo* link_in(const void* chain, VkStructureType type)
{
    for (auto* at = static_cast<const VkBaseInStructure*>(chain); at; at = at->pNext)
        if (at->sType == type) {
            auto* info = reinterpret_cast<LinkInfo*>(const_cast<VkBaseInStructure*>(at));
            if (info->function == VK_LAYER_LINK_INFO) return info;
        }
    return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* allocator, VkInstance* instance)
{
    if (!choose_device()) return VK_ERROR_LAYER_NOT_PRESENT;
    // As the loader does when all drivers are of that kind.
    if (test_device().portability && !(info->flags & VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR))
        return VK_ERROR_INCOMPATIBLE_DRIVER;
    auto* link =
        link_in<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (!link) return VK_ERROR_INITIALIZATION_FAILED;
    const PFN_vkGetInstanceProcAddr next = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(next(nullptr, "vkCreateInstance"));
    if (const VkResult result = create(info, allocator, instance); result != VK_SUCCESS) return result;
    auto made = std::make_unique<Instance>();
    made->handle = *instance;
    made->next = next;
    const auto get = [&](const char* name, auto& function) {
        function = reinterpret_cast<std::decay_t<decltype(function)>>(next(*instance, name));
    };
    get("vkDestroyInstance", made->destroy);
    get("vkGetPhysicalDeviceProperties", made->properties);
    get("vkGetPhysicalDeviceProperties2", made->properties2);
    get("vkGetPhysicalDeviceFeatures", made->features);
    get("vkGetPhysicalDeviceFeatures2", made->features2);
    get("vkEnumerateDeviceExtensionProperties", made->extensions);
    for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i)
        if (std::strcmp(info->ppEnabledExtensionNames[i], VK_EXT_DEBUG_UTILS_EXTENSION_NAME) == 0)
            get("vkSubmitDebugUtilsMessageEXT", made->submit_message);
    const std::scoped_lock lock(turn);
    instances[key_of(*instance)] = std::move(made);
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroy_instance(VkInstance instance, const VkAllocationCallbacks* allocator)
{
    if (!instance) return;
    const Key key = key_of(instance);
    const auto destroy = instance_of(instance).destroy;
    destroy(instance, allocator);
    const std::scoped_lock lock(turn);
    instances.erase(key);
}

/// Whether every feature that is asked for is reported.
bool has_features(const VkPhysicalDeviceFeatures& asked, const VkPhysicalDeviceFeatures& reported)
{
    constexpr std::size_t count = sizeof(VkPhysicalDeviceFeatures) / sizeof(VkBool32);
    VkBool32 a[count], b[count];
    std::memcpy(a, &asked, sizeof a);
    std::memcpy(b, &reported, sizeof b);
    for (std::size_t i = 0; i < count; ++i)
        if (a[i] && !b[i]) return false;
    return true;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator, VkDevice* device)
{
    const Instance& instance = instance_of(physical);
    for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i)
        if (!is_reported(info->ppEnabledExtensionNames[i]))
            return refuse(VK_ERROR_EXTENSION_NOT_PRESENT, std::string("the extension ") +
                                                              info->ppEnabledExtensionNames[i] +
                                                              " is enabled, but not reported");
    VkPhysicalDeviceFeatures reported{};
    get_features(physical, &reported);
    const auto* chained = in_chain<VkPhysicalDeviceFeatures2>(const_cast<void*>(info->pNext),
                                                              VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    if ((info->pEnabledFeatures && !has_features(*info->pEnabledFeatures, reported)) ||
        (chained && !has_features(chained->features, reported)))
        return refuse(VK_ERROR_FEATURE_NOT_PRESENT, "a feature is enabled, but not reported");

    auto* link = link_in<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    if (!link) return VK_ERROR_INITIALIZATION_FAILED;
    const PFN_vkGetInstanceProcAddr next = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    const PFN_vkGetDeviceProcAddr next_of_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;

    // The device below has no portability subset, and float controls without asking.
    std::vector<const char*> extensions;
    for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i) {
        const char* name = info->ppEnabledExtensionNames[i];
        if (std::strcmp(name, VK_KHR_PORTABILITY_SUBSET_EXTENSION_NAME) != 0 &&
            std::strcmp(name, VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME) != 0)
            extensions.push_back(name);
    }
    VkDeviceCreateInfo below = *info;
    below.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    below.ppEnabledExtensionNames = extensions.data();
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(next(instance.handle, "vkCreateDevice"));
    if (const VkResult result = create(physical, &below, allocator, device); result != VK_SUCCESS)
        return result;
    auto made = std::make_unique<Device>();
    made->handle = *device;
    made->next = next_of_device;
    made->instance = &instance;
    const std::scoped_lock lock(turn);
    devices[key_of(*device)] = std::move(made);
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice device, const VkAllocationCallbacks* allocator)
{
    if (!device) return;
    const Key key = key_of(device);
    const auto destroy = device_of(device).get<PFN_vkDestroyDevice>("vkDestroyDevice");
    destroy(device, allocator);
    const std::scoped_lock lock(turn);
    devices.erase(key);
}

bool is_buffer(VkDescriptorType type)
{
    return type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER || type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER ||
           type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC ||
           type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC;
}

constexpr VkShaderStageFlagBits counted_stages[] = {VK_SHADER_STAGE_VERTEX_BIT, VK_SHADER_STAGE_FRAGMENT_BIT,
                                                    VK_SHADER_STAGE_COMPUTE_BIT};

VKAPI_ATTR VkResult VKAPI_CALL create_set_layout(VkDevice device, const VkDescriptorSetLayoutCreateInfo* info,
                                                 const VkAllocationCallbacks* allocator,
                                                 VkDescriptorSetLayout* layout)
{
    Device& of = device_of(device);
    const auto create = of.get<PFN_vkCreateDescriptorSetLayout>("vkCreateDescriptorSetLayout");
    const VkResult result = create(device, info, allocator, layout);
    if (result != VK_SUCCESS) return result;
    BuffersOfStages buffers;
    for (std::uint32_t i = 0; i < info->bindingCount; ++i)
        for (const VkShaderStageFlagBits stage : counted_stages)
            if (is_buffer(info->pBindings[i].descriptorType) && (info->pBindings[i].stageFlags & stage))
                buffers[stage] += info->pBindings[i].descriptorCount;
    const std::scoped_lock lock(turn);
    of.set_layouts[*layout] = buffers;
    return result;
}

VKAPI_ATTR void VKAPI_CALL destroy_set_layout(VkDevice device, VkDescriptorSetLayout layout,
                                              const VkAllocationCallbacks* allocator)
{
    Device& of = device_of(device);
    of.get<PFN_vkDestroyDescriptorSetLayout>("vkDestroyDescriptorSetLayout")(device, layout, allocator);
    const std::scoped_lock lock(turn);
    of.set_layouts.erase(layout);
}

VKAPI_ATTR VkResult VKAPI_CALL create_pipeline_layout(VkDevice device, const VkPipelineLayoutCreateInfo* info,
                                                      const VkAllocationCallbacks* allocator,
                                                      VkPipelineLayout* layout)
{
    Device& of = device_of(device);
    for (const VkShaderStageFlagBits stage : counted_stages) {
        std::uint32_t used = 0;
        {
            const std::scoped_lock lock(turn);
            for (std::uint32_t i = 0; i < info->setLayoutCount; ++i)
                used += of.set_layouts[info->pSetLayouts[i]][stage];
        }
        for (std::uint32_t i = 0; i < info->pushConstantRangeCount; ++i)
            if (info->pPushConstantRanges[i].stageFlags & stage) {
                ++used;  // MoltenVK puts them into one
                break;
            }
        if (test_device().buffer_slots > 0 && used > test_device().buffer_slots)
            complain(*of.instance, "a layout has " + std::to_string(used) +
                                       " buffers in a stage, which has places for " +
                                       std::to_string(test_device().buffer_slots));
    }
    return of.get<PFN_vkCreatePipelineLayout>("vkCreatePipelineLayout")(device, info, allocator, layout);
}

VKAPI_ATTR VkResult VKAPI_CALL allocate_memory(VkDevice device, const VkMemoryAllocateInfo* info,
                                               const VkAllocationCallbacks* allocator, VkDeviceMemory* memory)
{
    Device& of = device_of(device);
    if (++of.allocations > test_device().allocations) {
        --of.allocations;
        return VK_ERROR_TOO_MANY_OBJECTS;  // as drivers do
    }
    const VkResult result = of.get<PFN_vkAllocateMemory>("vkAllocateMemory")(device, info, allocator, memory);
    if (result != VK_SUCCESS) --of.allocations;
    return result;
}

VKAPI_ATTR void VKAPI_CALL free_memory(VkDevice device, VkDeviceMemory memory,
                                       const VkAllocationCallbacks* allocator)
{
    Device& of = device_of(device);
    of.get<PFN_vkFreeMemory>("vkFreeMemory")(device, memory, allocator);
    if (memory) --of.allocations;
}

// --- the loader's way in
// -------------------------------------------------------------------------------------------

struct Hook {
    const char* name;
    PFN_vkVoidFunction function;
    bool of_device;
};

template <class Function>
PFN_vkVoidFunction plain(Function function)
{
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

PFN_vkVoidFunction find_hook(const char* name, bool of_device_only)
{
    static const Hook hooks[] = {
        {"vkCreateInstance", plain(create_instance), false},
        {"vkDestroyInstance", plain(destroy_instance), false},
        {"vkGetPhysicalDeviceProperties", plain(get_properties), false},
        {"vkGetPhysicalDeviceProperties2", plain(get_properties2), false},
        {"vkGetPhysicalDeviceProperties2KHR", plain(get_properties2), false},
        {"vkGetPhysicalDeviceFeatures", plain(get_features), false},
        {"vkGetPhysicalDeviceFeatures2", plain(get_features2), false},
        {"vkGetPhysicalDeviceFeatures2KHR", plain(get_features2), false},
        {"vkEnumerateDeviceExtensionProperties", plain(list_extensions), false},
        {"vkCreateDevice", plain(create_device), false},
        {"vkDestroyDevice", plain(destroy_device), true},
        {"vkCreateDescriptorSetLayout", plain(create_set_layout), true},
        {"vkDestroyDescriptorSetLayout", plain(destroy_set_layout), true},
        {"vkCreatePipelineLayout", plain(create_pipeline_layout), true},
        {"vkAllocateMemory", plain(allocate_memory), true},
        {"vkFreeMemory", plain(free_memory), true},
    };
    for (const Hook& hook : hooks)
        if ((hook.of_device || !of_device_only) && std::strcmp(hook.name, name) == 0) return hook.function;
    return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_function(VkDevice device, const char* name)
{
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return plain(get_device_function);
    if (const PFN_vkVoidFunction hook = find_hook(name, true)) return hook;
    return device_of(device).next(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_function(VkInstance instance, const char* name)
{
    if (std::strcmp(name, "vkGetInstanceProcAddr") == 0) return plain(get_instance_function);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return plain(get_device_function);
    if (const PFN_vkVoidFunction hook = find_hook(name, false)) return hook;
    return instance ? instance_of(instance).next(instance, name) : nullptr;
}

}  // namespace
}  // namespace pliant::limits

extern "C" VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* version)
{
    if (version->loaderLayerInterfaceVersion < 2) return VK_ERROR_INITIALIZATION_FAILED;
    version->loaderLayerInterfaceVersion = 2;
    version->pfnGetInstanceProcAddr = pliant::limits::get_instance_function;
    version->pfnGetDeviceProcAddr = pliant::limits::get_device_function;
    version->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
