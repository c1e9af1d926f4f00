#include "backend/vulkan/device.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include <vulkan/vulkan_beta.h>  // VK_KHR_portability_subset

#include "pliant/error.hpp"

namespace pliant::vulkan {
namespace {

int preference(const std::string& kind)  // smaller is better
{
    const char* order[] = {"discrete GPU", "integrated GPU", "virtual GPU", "other"};
    return static_cast<int>(std::find(std::begin(order), std::end(order), kind) - std::begin(order));
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

    choose(options.index);
    memory_properties_ = physical_.getMemoryProperties();

    queue_family_ = static_cast<std::uint32_t>(best_queue_family(physical_));
    const auto family = physical_.getQueueFamilyProperties()[queue_family_];
    can_draw_ = static_cast<bool>(family.queueFlags & vk::QueueFlagBits::eGraphics);
    timestamp_bits_ = family.timestampValidBits;
    timestamp_period_ = family.timestampValidBits > 0 ? physical_.getProperties().limits.timestampPeriod : 0;

    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue({}, queue_family_, 1, &priority);
    std::vector<const char*> extensions;
    if (!options.surface_extensions.empty()) {
        if (!offers(physical_, VK_KHR_SWAPCHAIN_EXTENSION_NAME))
            throw Error(ErrorKind::device_failure, "the device " + info_.name +
                                                       " cannot show pictures in a window; choose another "
                                                       "with --device, or use --headless");
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    }
    if (offers(physical_, VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME))
        extensions.push_back(VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME);
    // A device with this extension does not implement all of Vulkan (MoltenVK), and requires that we enable
    // it. All its features are enabled.
    VkPhysicalDevicePortabilitySubsetFeaturesKHR portable{};
    // Its name is declared only with VK_ENABLE_BETA_EXTENSIONS, which would have to be defined everywhere.
    portable.sType = static_cast<VkStructureType>(1000163000);
    const bool is_portable = offers(physical_, VK_KHR_PORTABILITY_SUBSET_EXTENSION_NAME);
    if (is_portable) {
        VkPhysicalDeviceFeatures2 all{};
        all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
        all.pNext = &portable;
        physical_.getDispatcher()->vkGetPhysicalDeviceFeatures2(static_cast<VkPhysicalDevice>(*physical_),
                                                                &all);
        extensions.push_back(VK_KHR_PORTABILITY_SUBSET_EXTENSION_NAME);
    }
    vk::DeviceCreateInfo creation({}, queue, {}, extensions);
    if (is_portable) creation.pNext = &portable;
    device_ = {physical_, creation};
    memory_pool_.emplace(device_, memory_properties_, info_.max_allocation);
    queue_ = device_.getQueue(queue_family_, 0);
    lane_ = CommandLane(*this);
    staging_ = CommandLane(*this);
    staging_commands_ = staging_.make_commands();
    pipelines_ = {physical_, device_, options.pipeline_folder};
}

void Device::choose(int index)
{
    std::vector<Candidate> usable;
    std::string refusals;
    for (Candidate& candidate : candidates_of(instance_)) {
        if (candidate.info.refusal.empty())
            usable.push_back(std::move(candidate));
        else
            refusals += "; " + candidate.info.name + " is refused: " + candidate.info.refusal;
    }
    if (usable.empty())
        throw Error(ErrorKind::device_failure,
                    "no Vulkan device that can run the passes was found" + refusals +
                        "; install a driver (on Debian, mesa-vulkan-drivers) or run with --backend cpu");
    if (index >= static_cast<int>(usable.size()) || index < -1)
        throw Error(
            ErrorKind::device_failure,
            "device " + std::to_string(index) + " does not exist: there " +
                (usable.size() == 1 ? "is 1 device" : "are " + std::to_string(usable.size()) + " devices") +
                ", counted from 0; see 'pliant info'");
    std::size_t chosen = index < 0 ? 0 : static_cast<std::size_t>(index);
    if (index < 0)
        for (std::size_t i = 1; i < usable.size(); ++i)
            if (preference(usable[i].info.kind) < preference(usable[chosen].info.kind)) chosen = i;
    physical_ = std::move(usable[chosen].physical);
    info_ = std::move(usable[chosen].info);
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
        throw refusal("its limit maxStorageBufferRange is " + std::to_string(info_.max_buffer_range >> 20) +
                      " MiB");
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
        if (needs.size > info_.max_allocation)
            throw refusal("its limit maxMemoryAllocationSize is " +
                          std::to_string(info_.max_allocation >> 20) + " MiB");
        buffer.memory = memory_pool_->take(needs, type, memory != Memory::device);
        buffer.handle.bindMemory(buffer.memory.memory(), buffer.memory.offset());
        if (memory == Memory::device) memory_made_ += needs.size;
        buffer.mapped = buffer.memory.mapped();
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

void Device::run(const std::function<void(const vk::raii::CommandBuffer&)>& record) const
{
    const std::scoped_lock turn(staging_turn_);
    const vk::raii::CommandBuffer& commands = staging_commands_;
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    record(commands);
    commands.end();
    staging_.run(commands);
}

void barrier(const vk::raii::CommandBuffer& commands, vk::PipelineStageFlags before, vk::AccessFlags written,
             vk::PipelineStageFlags after, vk::AccessFlags read)
{
    commands.pipelineBarrier(before, after, {}, vk::MemoryBarrier(written, read), {}, {});
}

}  // namespace pliant::vulkan
