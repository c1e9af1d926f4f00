// The layer that reports other devices' limits (tests/limits_layer): whatever exceeds a reported limit is
// reported or refused, and nothing else. Without this test the tests that use the layer could not fail.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "limits_layer/devices.hpp"
#include "test_paths.hpp"

namespace pliant::limits {
namespace {

/// A variable of the environment, put back at the end.
class Variable {
public:
    Variable(const char* name, const std::string& value) : name_(name)
    {
        if (const char* before = std::getenv(name)) before_ = before;
        setenv(name, value.c_str(), 1);
    }
    ~Variable()
    {
        if (before_)
            setenv(name_, before_->c_str(), 1);
        else
            unsetenv(name_);
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    const char* name_;
    std::optional<std::string> before_;
};

struct Wishes {
    bool portability = true, portability_subset = true;
    bool float_controls = true;  ///< their extension, where it is offered
    std::vector<const char*> extensions = {};
    vk::PhysicalDeviceFeatures features = {};
};

bool has(const std::vector<vk::ExtensionProperties>& list, const char* name)
{
    for (const auto& extension : list)
        if (std::string_view(extension.extensionName) == name) return true;
    return false;
}

/// A device under the layer, with the validation layer above it, and all that was said of it.
class Opened {
public:
    explicit Opened(const char* name, const Wishes& wishes = {})
        : layer_("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation:VK_LAYER_PLIANT_limits"),
          path_("VK_LAYER_PATH", test::limits_layer_path),
          device_name_("PLIANT_TEST_DEVICE", name)
    {
        const vk::ApplicationInfo application("limits_layer_test", 1, "", 1, VK_API_VERSION_1_3);
        std::vector<const char*> extensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
        vk::InstanceCreateFlags flags;
        if (wishes.portability) {
            extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
            flags = vk::InstanceCreateFlagBits::eEnumeratePortabilityKHR;
        }
        instance = {context_, vk::InstanceCreateInfo(flags, &application, {}, extensions)};
        using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
        using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
        messenger_ = {instance,
                      vk::DebugUtilsMessengerCreateInfoEXT(
                          {}, Severity::eWarning | Severity::eError,
                          Type::eGeneral | Type::eValidation | Type::ePerformance, keep, &messages)};
        physical = std::move(vk::raii::PhysicalDevices(instance).front());
        const auto offered = physical.enumerateDeviceExtensionProperties();
        std::vector<const char*> asked = wishes.extensions;
        for (const auto& [extension, wanted] :
             {std::pair{"VK_KHR_portability_subset", wishes.portability_subset},
              std::pair{VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME, wishes.float_controls}})
            if (wanted && has(offered, extension)) asked.push_back(extension);
        const float priority = 1;
        const vk::DeviceQueueCreateInfo queue({}, 0, 1, &priority);
        device = {physical, vk::DeviceCreateInfo({}, queue, {}, asked, &wishes.features)};
    }

    std::string said() const
    {
        std::string all;
        for (const std::string& message : messages) all += message + "\n";
        return all;
    }

private:
    static VKAPI_ATTR VkBool32 VKAPI_CALL keep(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                               VkDebugUtilsMessageTypeFlagsEXT,
                                               const VkDebugUtilsMessengerCallbackDataEXT* data,
                                               void* messages)
    {
        static_cast<std::vector<std::string>*>(messages)->push_back(data->pMessage);
        return VK_FALSE;
    }

    Variable layer_, path_, device_name_;
    vk::raii::Context context_;

public:
    std::vector<std::string> messages;
    vk::raii::Instance instance{nullptr};

private:
    vk::raii::DebugUtilsMessengerEXT messenger_{nullptr};

public:
    vk::raii::PhysicalDevice physical{nullptr};
    vk::raii::Device device{nullptr};
};

// --- what may go too far
// -------------------------------------------------------------------------------------------

struct Shader {
    std::uint32_t invocations = 64;
    std::uint32_t shared_bytes = 4;
    bool flushes_denormals = false;
};

/// A compute shader that does nothing, word by word.
std::vector<std::uint32_t> code_of(const Shader& shader)
{
    constexpr std::uint32_t entry = 1, no_value = 2, function = 3, number = 4, count = 5, array = 6,
                            pointer = 7, shared = 8, label = 9, bound = 10;
    std::vector<std::uint32_t> code = {0x07230203, 0x00010300, 0, bound, 0};
    const auto add = [&](std::uint32_t op, const std::vector<std::uint32_t>& operands) {
        code.push_back(static_cast<std::uint32_t>(operands.size() + 1) << 16 | op);
        code.insert(code.end(), operands.begin(), operands.end());
    };
    add(17, {1});  // OpCapability Shader
    if (shader.flushes_denormals) {
        add(17, {4465});  // DenormFlushToZero
        // OpExtension "SPV_KHR_float_controls"
        add(10, {0x5f565053, 0x5f52484b, 0x616f6c66, 0x6f635f74, 0x6f72746e, 0x0000736c});
    }
    add(14, {0, 1});                                 // OpMemoryModel Logical GLSL450
    add(15, {5, entry, 0x6e69616d, 0});              // OpEntryPoint GLCompute "main"
    add(16, {entry, 17, shader.invocations, 1, 1});  // OpExecutionMode LocalSize
    if (shader.flushes_denormals) add(16, {entry, 4460, 32});
    add(19, {no_value});
    add(33, {function, no_value});
    add(21, {number, 32, 0});
    add(43, {number, count, shader.shared_bytes / 4});
    add(28, {array, number, count});
    add(32, {pointer, 4, array});  // OpTypePointer Workgroup
    add(59, {pointer, shared, 4});
    add(54, {no_value, entry, 0, function});
    add(248, {label});
    add(253, {});
    add(56, {});
    return code;
}

void make_pipeline(const Opened& opened, const Shader& shader)
{
    const auto code = code_of(shader);
    const vk::raii::PipelineLayout layout(opened.device, vk::PipelineLayoutCreateInfo{});
    const vk::raii::ShaderModule module(opened.device, vk::ShaderModuleCreateInfo({}, code));
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main");
    const vk::raii::Pipeline pipeline(opened.device, nullptr,
                                      vk::ComputePipelineCreateInfo({}, stage, *layout));
}

vk::raii::DescriptorSetLayout set_layout(const Opened& opened, std::uint32_t storage, std::uint32_t uniform)
{
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (std::uint32_t b = 0; b < storage + uniform; ++b)
        bindings.emplace_back(
            b, b < storage ? vk::DescriptorType::eStorageBuffer : vk::DescriptorType::eUniformBuffer, 1,
            vk::ShaderStageFlagBits::eCompute);
    return {opened.device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

void make_layout(const Opened& opened, std::uint32_t storage, std::uint32_t uniform, std::uint32_t push_bytes)
{
    const auto set = set_layout(opened, storage, uniform);
    const vk::PushConstantRange push(vk::ShaderStageFlagBits::eCompute, 0, push_bytes);
    const vk::raii::PipelineLayout layout(opened.device, vk::PipelineLayoutCreateInfo({}, *set, push));
}

void allocate(const Opened& opened, int pieces)
{
    std::vector<vk::raii::DeviceMemory> kept;
    for (int i = 0; i < pieces; ++i) kept.emplace_back(opened.device, vk::MemoryAllocateInfo(4096, 0));
}

void try_to_allocate(const Opened& opened, int pieces)
{
    try {
        allocate(opened, pieces);
    } catch (const vk::TooManyObjectsError&) {  // what is said of it matters here
    }
}

void bind_buffer(const Opened& opened, vk::DeviceSize bytes, vk::DeviceSize offset = 0)
{
    const vk::raii::Buffer buffer(opened.device,
                                  vk::BufferCreateInfo({}, bytes, vk::BufferUsageFlagBits::eStorageBuffer));
    const auto needs = buffer.getMemoryRequirements();
    const vk::raii::DeviceMemory memory(opened.device, vk::MemoryAllocateInfo(needs.size, 0));
    buffer.bindMemory(*memory, 0);
    const auto layout = set_layout(opened, 1, 0);
    const vk::DescriptorPoolSize size(vk::DescriptorType::eStorageBuffer, 1);
    const vk::raii::DescriptorPool pool(
        opened.device,
        vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, size));
    const vk::DescriptorSetLayout handle = *layout;
    const vk::raii::DescriptorSets sets(opened.device, vk::DescriptorSetAllocateInfo(*pool, handle));
    const vk::DescriptorBufferInfo range(*buffer, offset, VK_WHOLE_SIZE);
    opened.device.updateDescriptorSets(
        vk::WriteDescriptorSet(*sets.front(), 0, 0, vk::DescriptorType::eStorageBuffer, {}, range), {});
}

struct Trespass {
    const char* device;
    std::function<void(const Opened&)> act;
    const char* said;       ///< of what is beyond the limits
    bool elsewhere = true;  ///< the same is within those of quest3
};

const Trespass trespasses[] = {
    {"tiny_stage_buffers", [](const Opened& o) { make_layout(o, 5, 0, 16); },
     "maxPerStageDescriptorStorageBuffers"},
    {"tiny_set_buffers", [](const Opened& o) { make_layout(o, 5, 0, 16); }, "maxDescriptorSetStorageBuffers"},
    {"tiny_slots", [](const Opened& o) { make_layout(o, 3, 1, 16); },
     "5 buffers in a stage, which has places for 4"},
    {"tiny_push", [](const Opened& o) { make_layout(o, 1, 0, 8); }, "maxPushConstantsSize"},
    {"tiny_invocations", [](const Opened& o) { make_pipeline(o, {.invocations = 256}); },
     "maxComputeWorkGroupInvocations"},
    {"tiny_group", [](const Opened& o) { make_pipeline(o, {.invocations = 256}); },
     "maxComputeWorkGroupSize"},
    {"tiny_shared", [](const Opened& o) { make_pipeline(o, {.shared_bytes = 8192}); },
     "maxComputeSharedMemorySize"},
    {"tiny_range", [](const Opened& o) { bind_buffer(o, 128 << 10); }, "maxStorageBufferRange"},
    {"tiny_allocations", [](const Opened& o) { try_to_allocate(o, 3); }, "maxMemoryAllocationCount"},
    {"adreno_610", [](const Opened& o) { make_pipeline(o, {.flushes_denormals = true}); },
     "DenormFlushToZero"},
    {"apple_m1", [](const Opened& o) { make_layout(o, 30, 1, 16); }, "32 buffers in a stage"},
    {"mali_g57", [](const Opened& o) { make_pipeline(o, {.invocations = 1024}); },
     "maxComputeWorkGroupInvocations"},
    {"quest3", [](const Opened& o) { bind_buffer(o, 1024, 64); }, "minStorageBufferOffsetAlignment", false},
};

class Limits : public testing::TestWithParam<Trespass> {};

TEST_P(Limits, AreToldWhenExceeded)
{
    const Opened opened(GetParam().device);
    EXPECT_EQ(opened.said(), "");
    GetParam().act(opened);
    EXPECT_NE(opened.said().find(GetParam().said), std::string::npos) << opened.said();
    if (!GetParam().elsewhere) return;
    const Opened within("quest3");
    GetParam().act(within);
    EXPECT_EQ(within.said(), "");
}

INSTANTIATE_TEST_SUITE_P(All, Limits, testing::ValuesIn(trespasses), [](const auto& param) {
    return std::string(param.param.device) + "_" + std::to_string(param.index);
});

TEST(LimitsLayer, ReportsTheTable)
{
    for (const TestDevice& device : test_devices()) {
        const Opened opened(device.name);
        const auto properties = opened.physical.getProperties();
        EXPECT_LE(properties.apiVersion, device.api_version | 0xfff) << device.name;
        EXPECT_EQ(std::string(properties.deviceName.data()).find(device.name), 0u);
        EXPECT_LE(properties.limits.maxComputeWorkGroupInvocations, device.invocations);
        EXPECT_LE(properties.limits.maxStorageBufferRange, device.storage_range);
        EXPECT_LE(properties.limits.maxPerStageDescriptorStorageBuffers, device.stage_storage_buffers);
        EXPECT_EQ(opened.physical.getFeatures().fillModeNonSolid == VK_TRUE, device.wires);
        const auto floats =
            opened.physical
                .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceFloatControlsProperties>()
                .get<vk::PhysicalDeviceFloatControlsProperties>();
        EXPECT_EQ(floats.shaderDenormFlushToZeroFloat32 == VK_TRUE, device.floats.flush_denormals)
            << device.name;
        EXPECT_EQ(floats.shaderRoundingModeRTEFloat32 == VK_TRUE, device.floats.round_to_nearest)
            << device.name;
        EXPECT_EQ(opened.said(), "") << device.name;
    }
}

TEST(LimitsLayer, AllocationsComeBack)
{
    const Opened opened("tiny_allocations");
    for (int k = 0; k < 3; ++k) EXPECT_NO_THROW(allocate(opened, 1));
    EXPECT_EQ(opened.said(), "");
    EXPECT_THROW(allocate(opened, 2), vk::TooManyObjectsError);
    EXPECT_NO_THROW(allocate(opened, 1));
}

TEST(LimitsLayer, OneDeviceHasWhatTheTinyOnesLack)
{
    EXPECT_NE(find_test_device("tiny_version"), nullptr);
    EXPECT_EQ(Opened("tiny_version").physical.getProperties().apiVersion, VK_API_VERSION_1_0);
    EXPECT_EQ(find_test_device("tiny"), nullptr);
    EXPECT_EQ(find_test_device(""), nullptr);
}

TEST(LimitsLayer, RefusesExtensionsThatAreNotReported)
{
    EXPECT_THROW(Opened("quest3", {.extensions = {VK_KHR_16BIT_STORAGE_EXTENSION_NAME}}),
                 vk::ExtensionNotPresentError);
    EXPECT_THROW(Opened("adreno_610", {.extensions = {VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME}}),
                 vk::ExtensionNotPresentError);
    EXPECT_NO_THROW(Opened("quest3", {.extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME}}));
}

TEST(LimitsLayer, RefusesFeaturesThatAreNotReported)
{
    vk::PhysicalDeviceFeatures geometry, wires;
    geometry.geometryShader = VK_TRUE;
    wires.fillModeNonSolid = VK_TRUE;
    EXPECT_THROW(Opened("quest3", {.features = geometry}), vk::FeatureNotPresentError);
    EXPECT_THROW(Opened("mali_g57", {.features = wires}), vk::FeatureNotPresentError);
    EXPECT_NO_THROW(Opened("quest3", {.features = wires}));
}

TEST(LimitsLayer, FloatControlsNeedTheirExtensionBefore12)
{
    const Opened without("quest3", {.float_controls = false});
    make_pipeline(without, {.flushes_denormals = true});
    EXPECT_NE(without.said().find("DenormFlushToZero"), std::string::npos) << without.said();
    const Opened of_13("mali_g57", {.float_controls = false});
    make_pipeline(of_13, {.flushes_denormals = true});
    EXPECT_EQ(of_13.said(), "");
}

TEST(LimitsLayer, PortabilityMustBeAskedFor)
{
    EXPECT_THROW(Opened("apple_m1", {.portability = false}), vk::IncompatibleDriverError);
    EXPECT_NO_THROW(Opened("quest3", {.portability = false}));
    const Opened without("apple_m1", {.portability_subset = false});
    EXPECT_NE(without.said().find("VK_KHR_portability_subset"), std::string::npos) << without.said();
}

TEST(LimitsLayer, WhatIsLaterThanADeviceIsLeftUntouched)
{
    const Opened opened("quest3");
    vk::PhysicalDeviceVulkan12Properties of_12;
    of_12.maxPerStageUpdateAfterBindResources = 7;
    vk::PhysicalDeviceProperties2 properties;
    properties.pNext = &of_12;
    // By the function itself: the C++ wrapper would begin with structures of its own.
    opened.physical.getDispatcher()->vkGetPhysicalDeviceProperties2(
        *opened.physical, reinterpret_cast<VkPhysicalDeviceProperties2*>(&properties));
    EXPECT_EQ(of_12.maxPerStageUpdateAfterBindResources, 7u);
}

}  // namespace
}  // namespace pliant::limits
