// Memory of buffers. Drivers allow few allocations (4,096 by many), and each is slow: so buffers take pieces
// of large blocks. Images have memory of their own, so that nothing here needs to keep both kinds apart.
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

/// Which parts of a block are free.
class FreeRanges {
public:
    explicit FreeRanges(std::uint64_t size) : size_(size) { ranges_[0] = size; }

    /// The smallest that is large enough is cut; nothing when there is none. `alignment` is a power of two.
    std::optional<std::uint64_t> take(std::uint64_t size, std::uint64_t alignment);
    /// What `take` gave, of the same size; it joins its free neighbours.
    void give(std::uint64_t first, std::uint64_t size);
    bool is_whole() const { return ranges_.size() == 1 && ranges_.begin()->second == size_; }

private:
    std::uint64_t size_;
    std::map<std::uint64_t, std::uint64_t> ranges_;  ///< bytes of a range, by where it begins
};

class MemoryPool;

/// Of a block; goes back to its pool, which must live longer, when it is gone.
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
    void* mapped() const { return mapped_; }  ///< null unless it was asked for

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

/// Threads may share it.
class PLIANT_INSIDE MemoryPool {
public:
    /// `most` is what one allocation may have, in bytes.
    MemoryPool(const vk::raii::Device& device, const vk::PhysicalDeviceMemoryProperties& properties,
               vk::DeviceSize most);
    ~MemoryPool();

    /// Throws vk::SystemError when there is no more.
    MemoryPiece take(const vk::MemoryRequirements& needs, std::uint32_t type, bool mapped);
    /// Blocks that there are.
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
