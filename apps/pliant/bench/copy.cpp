// The bandwidth of copying, for comparison with steps: by threads, or between two buffers of a device.
#include <algorithm>
#include <cstring>

#include "backend/cpu/jobs.hpp"
#include "backend/vulkan/device_state.hpp"
#include "bench/harness.hpp"
#include "stopwatch.hpp"

namespace pliant::tool {
namespace {

class HostCopy final : public MemoryCopy {
public:
    HostCopy(unsigned threads, std::size_t bytes)
        : jobs_(cpu::make_job_system(threads)), threads_(threads), from_(bytes, 1), to_(bytes, 2)
    {
    }

    double gigabytes_per_second() override
    {
        const auto start = Clock::now();
        jobs_->run(
            threads_,
            [](void* context, unsigned part) {
                auto& copy = *static_cast<HostCopy*>(context);
                const std::size_t begin = copy.from_.size() * part / copy.threads_;
                const std::size_t end = copy.from_.size() * (part + 1) / copy.threads_;
                std::memcpy(copy.to_.data() + begin, copy.from_.data() + begin, end - begin);
            },
            this);
        return 2e-9 * static_cast<double>(from_.size()) / seconds_since(start);
    }

private:
    std::unique_ptr<JobSystem> jobs_;
    unsigned threads_;
    std::vector<char> from_, to_;
};

class DeviceCopy final : public MemoryCopy {
public:
    DeviceCopy(std::shared_ptr<vulkan::Device> device, std::size_t bytes)
        : device_(std::move(device)),
          from_(device_->make_buffer(bytes, vk::BufferUsageFlagBits::eTransferSrc, vulkan::Memory::device,
                                     "copied from")),
          to_(device_->make_buffer(bytes, vk::BufferUsageFlagBits::eTransferDst, vulkan::Memory::device,
                                   "copied to")),
          commands_(device_->make_commands())
    {
        const bool timed = device_->timestamp_period() > 0;
        if (timed) times_ = {device_->handle(), vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 2)};
        commands_.begin(vk::CommandBufferBeginInfo{});
        if (timed) {
            commands_.resetQueryPool(*times_, 0, 2);
            commands_.writeTimestamp(vk::PipelineStageFlagBits::eTopOfPipe, *times_, 0);
        }
        for (int k = 0; k < copies; ++k) {
            commands_.copyBuffer(*from_, *to_, vk::BufferCopy(0, 0, from_.size));
            vulkan::barrier(commands_, vk::PipelineStageFlagBits::eTransfer,
                            vk::AccessFlagBits::eTransferWrite, vk::PipelineStageFlagBits::eTransfer,
                            vk::AccessFlagBits::eTransferWrite);
        }
        if (timed) commands_.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *times_, 1);
        commands_.end();
    }

    double gigabytes_per_second() override
    {
        const auto start = Clock::now();
        device_->run(commands_);
        double seconds = seconds_since(start);
        if (device_->timestamp_period() > 0) {
            const auto ticks = times_.getResults<std::uint64_t>(
                0, 2, 2 * sizeof(std::uint64_t), sizeof(std::uint64_t), vk::QueryResultFlagBits::e64);
            seconds = 1e-9 * device_->timestamp_period() *
                      static_cast<double>(device_->ticks_between(ticks.second[0], ticks.second[1]));
        }
        return copies * 2e-9 * static_cast<double>(from_.size) / seconds;
    }

private:
    static constexpr int copies = 4;
    std::shared_ptr<vulkan::Device> device_;
    vulkan::Buffer from_, to_;
    vk::raii::QueryPool times_{nullptr};
    vk::raii::CommandBuffer commands_;
};

}  // namespace

std::unique_ptr<MemoryCopy> make_memory_copy(Simulation& simulation, std::size_t bytes)
{
    if (DeviceState* state = simulation.device_state())
        return std::make_unique<DeviceCopy>(state->device(), bytes);
    return std::make_unique<HostCopy>(std::max(1u, simulation.thread_count()), bytes);
}

}  // namespace pliant::tool
