// A Vulkan 1.1 device with its buffers and one queue. Shared by the compute backend and the renderer.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "backend/vulkan/memory_pool.hpp"
#include "backend/vulkan/physical_devices.hpp"
#include "backend/vulkan/pipeline_store.hpp"
#include "pliant/api.hpp"

namespace pliant::vulkan {

struct DeviceOptions {
    int index = -1;  ///< as listed by list_physical_devices(); -1 takes the best: discrete, integrated,
                     ///< virtual, other, software
    /// For windows: instance extensions that the surface needs; with any, the device can present.
    std::vector<const char*> surface_extensions = {};
    bool validation = false;  ///< enables VK_LAYER_KHRONOS_validation; its messages are counted and printed
    std::filesystem::path pipeline_folder = {};  ///< see SimulationOptions
};

/// The kind of memory of a buffer.
enum class Memory {
    device,    ///< fast for shaders; fill it by Device::write
    upload,    ///< host-visible and mapped, written by the host, read by shaders
    readback,  ///< host-visible, mapped, preferably cached: the host reads it
};

/// A buffer with its memory, a range of a block; `mapped` is null for Memory::device.
struct Buffer {
    MemoryPiece memory;
    vk::raii::Buffer handle{nullptr};
    vk::DeviceSize size = 0;  ///< bytes
    void* mapped = nullptr;

    vk::Buffer operator*() const { return *handle; }
    vk::DescriptorBufferInfo descriptor() const { return {*handle, 0, VK_WHOLE_SIZE}; }
};

class Device;

/// Command buffers of one thread, since Vulkan pools are not thread-safe, and a fence to wait for them.
class PLIANT_INSIDE CommandLane {
public:
    CommandLane() = default;
    explicit CommandLane(const Device& device);

    /// A primary command buffer that can be submitted repeatedly.
    vk::raii::CommandBuffer make_commands() const;
    /// Submits and waits; throws vk::SystemError when the device is lost.
    void run(const vk::raii::CommandBuffer& commands) const;

private:
    const Device* device_ = nullptr;
    vk::raii::CommandPool pool_{nullptr};
    vk::raii::Fence fence_{nullptr};
};

/// Thread-safe: submissions, reads and writes are serialised. Command buffers of `make_commands` and `run`
/// belong to the drawing thread; other threads have their own CommandLane.
class PLIANT_INSIDE Device {
public:
    /// Throws Error(device_failure) if there is no such device; the message says what to install or choose.
    explicit Device(const DeviceOptions& options);
    ~Device() { pipelines_.keep(); }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const PhysicalDeviceInfo& info() const { return info_; }
    const vk::raii::Device& handle() const { return device_; }
    const vk::raii::PhysicalDevice& physical() const { return physical_; }
    const vk::raii::Instance& instance() const { return instance_; }
    std::uint32_t queue_family() const { return queue_family_; }
    bool can_draw() const { return can_draw_; }                    ///< the queue supports graphics, too
    double timestamp_period() const { return timestamp_period_; }  ///< ns per tick; 0 without timestamps
    /// Ticks between two timestamps; masks the queue's valid bits.
    std::uint64_t ticks_between(std::uint64_t first, std::uint64_t second) const
    {
        return (second - first) & (timestamp_bits_ >= 64 ? ~0ull : (1ull << timestamp_bits_) - 1);
    }

    /// Throws Error(device_failure), naming the buffer, if the device cannot allocate it.
    Buffer make_buffer(vk::DeviceSize size, vk::BufferUsageFlags usage, Memory memory,
                       const char* name) const;
    /// Total bytes of all buffers of Memory::device so far, for reports of a simulation's size.
    std::uint64_t memory_made() const { return memory_made_; }
    /// The number of memory blocks.
    std::size_t allocation_count() const { return memory_pool_->allocation_count(); }
    std::uint32_t memory_type(std::uint32_t allowed_types, vk::MemoryPropertyFlags wanted,
                              vk::MemoryPropertyFlags preferred = {}) const;
    vk::raii::ShaderModule make_shader(std::span<const std::uint32_t> code) const;
    /// Use it to create pipelines, then call keep().
    PipelineStore& pipelines() const { return pipelines_; }

    /// A primary command buffer that can be submitted repeatedly.
    vk::raii::CommandBuffer make_commands() const { return lane_.make_commands(); }
    /// The only queue; use it through `submit` and `present`, which serialise access.
    const vk::raii::Queue& queue() const { return queue_; }
    void submit(const vk::SubmitInfo& submission, vk::Fence done = nullptr) const;
    vk::Result present(const vk::PresentInfoKHR& presentation) const;
    /// Waits until all submitted work has run.
    void wait_idle() const;
    /// Storage for an object that should live as long as the device, for example pipelines, by name; it must
    /// not own the device.
    std::shared_ptr<void>& kept(const char* name) const { return kept_[name]; }
    /// Submits and waits; throws vk::SystemError when the device is lost.
    void run(const vk::raii::CommandBuffer& commands) const { lane_.run(commands); }

    /// Copies through a staging buffer and waits. A staging buffer of up to 16 MiB is kept for each
    /// direction, so that reading every frame allocates nothing.
    void write(const Buffer& target, const void* data, std::size_t bytes, std::size_t offset = 0) const;
    void read(const Buffer& source, void* data, std::size_t bytes, std::size_t offset = 0) const;
    /// Runs the commands that `record` records, and waits.
    void run(const std::function<void(const vk::raii::CommandBuffer&)>& record) const;

    /// Number of messages of the validation layer so far (warnings and errors).
    std::uint64_t validation_messages() const { return validation_messages_; }
    /// The same for all devices since the program began, including messages while they were destroyed.
    static std::uint64_t all_validation_messages();

private:
    void open(const DeviceOptions& options);
    /// Chooses among the usable devices: see DeviceOptions.
    void choose(int index);
    /// A kept staging buffer, or `large` if that would be too large to keep; call under `staging_turn_`.
    const Buffer& staging_for(std::size_t bytes, Memory memory, Buffer& large) const;

    mutable std::atomic<std::uint64_t> validation_messages_{0};
    mutable std::atomic<std::uint64_t> memory_made_{0};
    vk::raii::Context context_;
    vk::raii::Instance instance_{nullptr};
    vk::raii::DebugUtilsMessengerEXT messenger_{nullptr};
    vk::raii::PhysicalDevice physical_{nullptr};
    PhysicalDeviceInfo info_;
    std::uint32_t queue_family_ = 0;
    bool can_draw_ = false;
    double timestamp_period_ = 0;
    std::uint32_t timestamp_bits_ = 0;
    vk::raii::Device device_{nullptr};
    vk::raii::Queue queue_{nullptr};
    CommandLane lane_, staging_;
    vk::raii::CommandBuffer staging_commands_{nullptr};
    mutable std::optional<MemoryPool> memory_pool_;  // declared before its users, so that it outlives them
    mutable Buffer upload_staging_, readback_staging_;
    mutable std::mutex queue_turn_, staging_turn_;
    vk::PhysicalDeviceMemoryProperties memory_properties_;
    mutable PipelineStore pipelines_;
    mutable std::map<std::string, std::shared_ptr<void>> kept_;
};

/// A full barrier between all earlier and all later commands, for commands recorded by hand.
PLIANT_INSIDE void barrier(const vk::raii::CommandBuffer& commands, vk::PipelineStageFlags before,
                           vk::AccessFlags written, vk::PipelineStageFlags after, vk::AccessFlags read);

}  // namespace pliant::vulkan
