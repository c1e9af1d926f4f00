// Memory of buffers. Drivers allow few allocations (many only 4,096), and each is slow, so buffers take
// ranges of large blocks. Images have their own memory, so both kinds never share a block.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "pliant/api.hpp"

namespace pliant::vulkan {

/// The free ranges of a block.
class FreeRanges {
public:
    explicit FreeRanges(std::uint64_t size) : size_(size) { ranges_[0] = size; }

    /// Takes from the smallest range that fits; empty if none does. `alignment` is a power of two.
    std::optional<std::uint64_t> take(std::uint64_t size, std::uint64_t alignment);
    /// Returns a range of `take`, with the same size; it merges with its free neighbours.
    void give(std::uint64_t first, std::uint64_t size);
    bool is_whole() const { return ranges_.size() == 1 && ranges_.begin()->second == size_; }

private:
    std::uint64_t size_;
    std::map<std::uint64_t, std::uint64_t> ranges_;  ///< size of each range, by its beginning; bytes
};

class MemoryPool;

/// A range of a block. Its destructor returns it to its pool, which must live longer.
class PLIANT_INSIDE MemoryPiece {
public:
    MemoryPiece() = default;
    MemoryPiece(MemoryPiece&& other) noexcept { swap(other); }
    MemoryPiece& operator=(MemoryPiece&& other) noexcept
    {
        MemoryPiece(std::move(other)).swap(*this);
        return *this;
    }
    ~MemoryPiece();

    vk::DeviceMemory memory() const;
    vk::DeviceSize offset() const { return offset_; }
    void* mapped() const { return mapped_; }  ///< null unless requested

private:
    friend class MemoryPool;
    void swap(MemoryPiece& other) noexcept
    {
        std::swap(pool_, other.pool_);
        std::swap(block_, other.block_);
        std::swap(offset_, other.offset_);
        std::swap(size_, other.size_);
        std::swap(mapped_, other.mapped_);
    }

    MemoryPool* pool_ = nullptr;
    struct MemoryBlock* block_ = nullptr;
    vk::DeviceSize offset_ = 0, size_ = 0;
    void* mapped_ = nullptr;
};

/// Thread-safe.
class PLIANT_INSIDE MemoryPool {
public:
    /// `most`: the maximum size of one allocation, bytes.
    MemoryPool(const vk::raii::Device& device, const vk::PhysicalDeviceMemoryProperties& properties,
               vk::DeviceSize most);
    ~MemoryPool();

    /// Throws vk::SystemError if the memory is exhausted.
    MemoryPiece take(const vk::MemoryRequirements& needs, std::uint32_t type, bool mapped);
    /// The number of blocks.
    std::size_t allocation_count() const;

private:
    friend class MemoryPiece;
    void give(MemoryBlock& block, vk::DeviceSize offset, vk::DeviceSize size) noexcept;
    MemoryBlock& add_block(vk::DeviceSize least, std::uint32_t type);

    const vk::raii::Device& device_;
    vk::PhysicalDeviceMemoryProperties properties_;
    vk::DeviceSize most_;
    mutable std::mutex turn_;
    std::vector<std::unique_ptr<MemoryBlock>> blocks_;
};

}  // namespace pliant::vulkan
