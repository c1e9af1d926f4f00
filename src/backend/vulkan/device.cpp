#include "backend/vulkan/device.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "backend/vulkan/bindings.hpp"
#include "pliant/error.hpp"
#include "solve/pass.hpp"

namespace pliant::vulkan {
namespace {

constexpr std::uint32_t api_version = VK_API_VERSION_1_2;
constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

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

int preference(const std::string& kind)  // smaller is better
{
    const char* order[] = {"discrete GPU", "integrated GPU", "virtual GPU", "other"};
    return static_cast<int>(std::find(std::begin(order), std::end(order), kind) - std::begin(order));
}

/// The family with compute, and with graphics where there is one: pictures are drawn from the same queue.
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

/// Version, queue, and the limits that the compute passes need (bindings.hpp, shaders/measure.glsl).
bool usable(const vk::raii::PhysicalDevice& physical)
{
    constexpr std::uint32_t invocations = block_size, shared_memory = block_size * 32;
    const auto properties = physical.getProperties();
    return properties.apiVersion >= api_version && best_queue_family(physical) >= 0 &&
           properties.limits.maxPerStageDescriptorStorageBuffers >= storage_buffer_count() &&
           properties.limits.maxComputeWorkGroupInvocations >= invocations &&
           properties.limits.maxComputeSharedMemorySize >= shared_memory;
}

PhysicalDeviceInfo describe(const vk::raii::PhysicalDevice& physical, int index)
{
    const auto properties = physical.getProperties();
    PhysicalDeviceInfo info;
    info.index = index;
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
    return info;
}

vk::raii::Instance make_instance(const vk::raii::Context& context, bool validation,
                                 std::vector<const char*> extensions = {})
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
    const vk::ApplicationInfo application("pliant", 1, "pliant", 1, api_version);
    return {context, vk::InstanceCreateInfo({}, &application, layers, extensions)};
}

std::atomic<std::uint64_t> all_messages{0};

VKAPI_ATTR VkBool32 VKAPI_CALL count_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                             VkDebugUtilsMessageTypeFlagsEXT,
                                             const VkDebugUtilsMessengerCallbackDataEXT* data, void* counter)
{
    ++*static_cast<std::atomic<std::uint64_t>*>(counter);
    ++all_messages;
    std::fprintf(stderr, "vulkan validation: %s\n", data->pMessage);
    return VK_FALSE;
}

}  // namespace

std::vector<PhysicalDeviceInfo> list_physical_devices() noexcept
{
    std::vector<PhysicalDeviceInfo> result;
    try {
        const vk::raii::Context context;
        const auto instance = make_instance(context, false);
        for (const auto& physical : vk::raii::PhysicalDevices(instance))
            if (usable(physical)) result.push_back(describe(physical, static_cast<int>(result.size())));
    } catch (const std::exception&) {
        result.clear();  // no loader, no driver: there are no devices
    }
    return result;
}

Device::Device(const DeviceOptions& options)
try {
    open(options);
} catch (const vk::SystemError& error) {
    throw Error(ErrorKind::device_failure,
                std::string("Vulkan cannot be used here: ") + error.what() +
                    "; install a Vulkan driver (on Debian, mesa-vulkan-drivers) or run with "
                    "--backend cpu");
} catch (const std::runtime_error& error) {
    if (const auto* known = dynamic_cast<const Error*>(&error)) throw *known;
    throw Error(ErrorKind::device_failure,
                "no Vulkan loader was found: install libvulkan1, or run with --backend cpu");
}

void Device::open(const DeviceOptions& options)
{
    instance_ = make_instance(context_, options.validation, options.surface_extensions);
    if (options.validation) {
        using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
        using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
        messenger_ = {instance_, vk::DebugUtilsMessengerCreateInfoEXT(
                                     {}, Severity::eWarning | Severity::eError,
                                     Type::eGeneral | Type::eValidation | Type::ePerformance, count_message,
                                     &validation_messages_)};
    }

    std::vector<vk::raii::PhysicalDevice> candidates;
    for (auto& physical : vk::raii::PhysicalDevices(instance_))
        if (usable(physical)) candidates.push_back(std::move(physical));
    if (candidates.empty())
        throw Error(ErrorKind::device_failure,
                    "no Vulkan 1.2 device that can run the passes was found: install a driver (on Debian, "
                    "mesa-vulkan-drivers) or run with "
                    "--backend cpu");
    if (options.index >= static_cast<int>(candidates.size()) || options.index < -1)
        throw Error(ErrorKind::device_failure,
                    "device " + std::to_string(options.index) + " does not exist: there " +
                        (candidates.size() == 1 ? "is 1 device"
                                                : "are " + std::to_string(candidates.size()) + " devices") +
                        ", counted from 0; see 'pliant info'");
    std::size_t chosen = options.index < 0 ? 0 : static_cast<std::size_t>(options.index);
    if (options.index < 0)
        for (std::size_t i = 1; i < candidates.size(); ++i)
            if (preference(describe(candidates[i], 0).kind) <
                preference(describe(candidates[chosen], 0).kind))
                chosen = i;
    physical_ = std::move(candidates[chosen]);
    info_ = describe(physical_, static_cast<int>(chosen));
    memory_properties_ = physical_.getMemoryProperties();

    queue_family_ = static_cast<std::uint32_t>(best_queue_family(physical_));
    const auto family = physical_.getQueueFamilyProperties()[queue_family_];
    can_draw_ = static_cast<bool>(family.queueFlags & vk::QueueFlagBits::eGraphics);
    timestamp_bits_ = family.timestampValidBits;
    timestamp_period_ = family.timestampValidBits > 0 ? physical_.getProperties().limits.timestampPeriod : 0;

    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue({}, queue_family_, 1, &priority);
    const auto available = physical_.getFeatures();
    vk::PhysicalDeviceFeatures features;
    features.fillModeNonSolid = available.fillModeNonSolid;  // the wireframe overlay
    draws_wires_ = features.fillModeNonSolid == VK_TRUE;
    std::vector<const char*> extensions;
    if (!options.surface_extensions.empty()) {
        const auto offered = physical_.enumerateDeviceExtensionProperties();
        if (std::none_of(offered.begin(), offered.end(), [](const auto& extension) {
                return std::strcmp(extension.extensionName, VK_KHR_SWAPCHAIN_EXTENSION_NAME) == 0;
            }))
            throw Error(ErrorKind::device_failure, "the device " + info_.name +
                                                       " cannot show pictures in a window; choose another "
                                                       "with --device, or use --headless");
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    }
    device_ = {physical_, vk::DeviceCreateInfo({}, queue, {}, extensions, &features)};
    queue_ = device_.getQueue(queue_family_, 0);
    lane_ = CommandLane(*this);
    staging_ = CommandLane(*this);
    staging_commands_ = staging_.make_commands();
    pipelines_ = {physical_, device_, options.pipeline_folder};
}

std::uint64_t Device::all_validation_messages() { return all_messages; }

std::uint32_t Device::memory_type(std::uint32_t allowed_types, vk::MemoryPropertyFlags wanted,
                                  vk::MemoryPropertyFlags preferred) const
{
    for (const auto flags : {wanted | preferred, wanted})
        for (std::uint32_t i = 0; i < memory_properties_.memoryTypeCount; ++i)
            if ((allowed_types >> i & 1) &&
                (memory_properties_.memoryTypes[i].propertyFlags & flags) == flags)
                return i;
    throw Error(ErrorKind::device_failure,
                "the device " + info_.name + " has no memory of the kind a buffer needs");
}

Buffer Device::make_buffer(vk::DeviceSize size, vk::BufferUsageFlags usage, Memory memory,
                           const char* name) const
{
    using Property = vk::MemoryPropertyFlagBits;
    size = std::max<vk::DeviceSize>(size, 16);  // Vulkan has no empty buffers
    const auto refusal = [&](const std::string& why) {
        return Error(ErrorKind::device_failure, std::string("the buffer '") + name + "' of " +
                                                    std::to_string(size >> 20) + " MiB does not fit on " +
                                                    info_.name + ": " + why +
                                                    "; use fewer nodes or another backend");
    };
    if ((usage & vk::BufferUsageFlagBits::eStorageBuffer) && size > info_.max_buffer_range)
        throw refusal("a storage buffer holds at most " + std::to_string(info_.max_buffer_range >> 20) +
                      " MiB there");
    try {
        Buffer buffer;
        buffer.size = size;
        buffer.handle = {device_, vk::BufferCreateInfo({}, size,
                                                       usage | vk::BufferUsageFlagBits::eTransferSrc |
                                                           vk::BufferUsageFlagBits::eTransferDst)};
        const auto needs = buffer.handle.getMemoryRequirements();
        const auto host = Property::eHostVisible | Property::eHostCoherent;
        const std::uint32_t type =
            memory == Memory::device   ? memory_type(needs.memoryTypeBits, Property::eDeviceLocal)
            : memory == Memory::upload ? memory_type(needs.memoryTypeBits, host, Property::eDeviceLocal)
                                       : memory_type(needs.memoryTypeBits, host, Property::eHostCached);
        buffer.memory = {device_, vk::MemoryAllocateInfo(needs.size, type)};
        buffer.handle.bindMemory(*buffer.memory, 0);
        if (memory == Memory::device) memory_made_ += needs.size;
        if (memory != Memory::device) buffer.mapped = buffer.memory.mapMemory(0, VK_WHOLE_SIZE);
        return buffer;
    } catch (const vk::SystemError& error) {
        throw refusal(error.what());
    }
}

vk::raii::ShaderModule Device::make_shader(std::span<const std::uint32_t> code) const
{
    return {device_, vk::ShaderModuleCreateInfo({}, code.size_bytes(), code.data())};
}

CommandLane::CommandLane(const Device& device)
    : device_(&device),
      pool_(device.handle(), vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                                       device.queue_family())),
      fence_(device.handle(), vk::FenceCreateInfo{})
{
}

vk::raii::CommandBuffer CommandLane::make_commands() const
{
    return std::move(
        vk::raii::CommandBuffers(device_->handle(), {*pool_, vk::CommandBufferLevel::ePrimary, 1}).front());
}

void CommandLane::run(const vk::raii::CommandBuffer& commands) const
{
    device_->handle().resetFences(*fence_);
    const vk::CommandBuffer handle = *commands;
    device_->submit(vk::SubmitInfo({}, {}, handle), *fence_);
    if (device_->handle().waitForFences(*fence_, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess)
        throw vk::SystemError(vk::make_error_code(vk::Result::eTimeout), "waiting for the device");
}

void Device::submit(const vk::SubmitInfo& submission, vk::Fence done) const
{
    const std::scoped_lock turn(queue_turn_);
    queue_.submit(submission, done);
}

vk::Result Device::present(const vk::PresentInfoKHR& presentation) const
{
    const std::scoped_lock turn(queue_turn_);
    return queue_.presentKHR(presentation);
}

void Device::wait_idle() const
{
    const std::scoped_lock turn(queue_turn_);
    device_.waitIdle();
}

const Buffer& Device::staging_for(std::size_t bytes, Memory memory, Buffer& large) const
{
    constexpr std::size_t most_kept = 16u << 20;
    Buffer& kept = memory == Memory::upload ? upload_staging_ : readback_staging_;
    if (kept.size >= bytes) return kept;
    Buffer& made = bytes <= most_kept ? kept : large;
    made = make_buffer(bytes, {}, memory, "staging");
    return made;
}

void Device::write(const Buffer& target, const void* data, std::size_t bytes, std::size_t offset) const
{
    if (bytes == 0) return;
    if (target.mapped) {
        std::memcpy(static_cast<char*>(target.mapped) + offset, data, bytes);
        return;
    }
    const std::scoped_lock turn(staging_turn_);
    Buffer large;
    const Buffer& staging = staging_for(bytes, Memory::upload, large);
    std::memcpy(staging.mapped, data, bytes);
    const vk::raii::CommandBuffer& commands = staging_commands_;
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    commands.copyBuffer(*staging, *target, vk::BufferCopy(0, offset, bytes));
    barrier(commands, vk::PipelineStageFlagBits::eTransfer, vk::AccessFlagBits::eTransferWrite,
            vk::PipelineStageFlagBits::eAllCommands,
            vk::AccessFlagBits::eMemoryRead | vk::AccessFlagBits::eMemoryWrite);
    commands.end();
    staging_.run(commands);
}

void Device::read(const Buffer& source, void* data, std::size_t bytes, std::size_t offset) const
{
    if (bytes == 0) return;
    if (source.mapped) {
        std::memcpy(data, static_cast<const char*>(source.mapped) + offset, bytes);
        return;
    }
    const std::scoped_lock turn(staging_turn_);
    Buffer large;
    const Buffer& staging = staging_for(bytes, Memory::readback, large);
    const vk::raii::CommandBuffer& commands = staging_commands_;
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    barrier(commands, vk::PipelineStageFlagBits::eAllCommands, vk::AccessFlagBits::eMemoryWrite,
            vk::PipelineStageFlagBits::eTransfer, vk::AccessFlagBits::eTransferRead);
    commands.copyBuffer(*source, *staging, vk::BufferCopy(offset, 0, bytes));
    barrier(commands, vk::PipelineStageFlagBits::eTransfer, vk::AccessFlagBits::eTransferWrite,
            vk::PipelineStageFlagBits::eHost, vk::AccessFlagBits::eHostRead);
    commands.end();
    staging_.run(commands);
    std::memcpy(data, staging.mapped, bytes);
}

void barrier(const vk::raii::CommandBuffer& commands, vk::PipelineStageFlags before, vk::AccessFlags written,
             vk::PipelineStageFlags after, vk::AccessFlags read)
{
    commands.pipelineBarrier(before, after, {}, vk::MemoryBarrier(written, read), {}, {});
}

}  // namespace pliant::vulkan
