#include "backend/vulkan/memory_pool.hpp"

#include <algorithm>

namespace pliant::vulkan {

/// Memory of one type, mapped as a whole when first needed.
struct MemoryBlock {
    std::uint32_t type = 0;
    vk::DeviceSize size = 0;
    vk::raii::DeviceMemory memory{nullptr};
    char* mapped = nullptr;
    FreeRanges free{0};
};

std::optional<std::uint64_t> FreeRanges::take(std::uint64_t size, std::uint64_t alignment)
{
    auto best = ranges_.end();
    std::uint64_t first = 0;
    for (auto range = ranges_.begin(); range != ranges_.end(); ++range) {
        const std::uint64_t aligned = (range->first + alignment - 1) & ~(alignment - 1);
        const std::uint64_t skipped = aligned - range->first;
        if (range->second < skipped || range->second - skipped < size) continue;
        if (best != ranges_.end() && range->second >= best->second) continue;
        best = range;
        first = aligned;
    }
    if (best == ranges_.end()) return std::nullopt;
    const auto [begin, length] = *best;
    ranges_.erase(best);
    if (first > begin) ranges_[begin] = first - begin;
    if (first + size < begin + length) ranges_[first + size] = begin + length - first - size;
    return first;
}

void FreeRanges::give(std::uint64_t first, std::uint64_t size)
{
    auto after = ranges_.lower_bound(first);
    if (after != ranges_.end() && after->first == first + size) {
        size += after->second;
        after = ranges_.erase(after);
    }
    if (after != ranges_.begin()) {
        auto& [begin, length] = *std::prev(after);
        if (begin + length == first) {
            length += size;
            return;
        }
    }
    ranges_[first] = size;
}

MemoryPiece::~MemoryPiece()
{
    if (pool_) pool_->give(*block_, offset_, size_);
}

vk::DeviceMemory MemoryPiece::memory() const { return *block_->memory; }

MemoryPool::MemoryPool(const vk::raii::Device& device, const vk::PhysicalDeviceMemoryProperties& properties,
                       vk::DeviceSize most)
    : device_(device), properties_(properties), most_(most)
{
}
MemoryPool::~MemoryPool() = default;

MemoryPiece MemoryPool::take(const vk::MemoryRequirements& needs, std::uint32_t type, bool mapped)
{
    const std::scoped_lock turn(turn_);
    MemoryBlock* block = nullptr;
    std::optional<std::uint64_t> offset;
    for (const auto& known : blocks_) {
        if (known->type != type) continue;
        offset = known->free.take(needs.size, needs.alignment);
        block = known.get();
        if (offset) break;
    }
    if (!offset) {
        block = &add_block(needs.size, type);
        offset = block->free.take(needs.size, needs.alignment);
    }
    if (mapped && !block->mapped) {
        try {
            block->mapped = static_cast<char*>(block->memory.mapMemory(0, VK_WHOLE_SIZE));
        } catch (const vk::SystemError&) {
            block->free.give(*offset, needs.size);
            throw;
        }
    }
    MemoryPiece piece;
    piece.pool_ = this;
    piece.block_ = block;
    piece.offset_ = *offset;
    piece.size_ = needs.size;
    if (mapped) piece.mapped_ = block->mapped + *offset;
    return piece;
}

/// A new block is as large as all blocks of its type so far, so that few are needed and less than half is
/// unused; in small memories it is smaller.
MemoryBlock& MemoryPool::add_block(vk::DeviceSize least, std::uint32_t type)
{
    constexpr vk::DeviceSize smallest = 1u << 20, largest = 64u << 20, shares = 8;
    vk::DeviceSize there_is = 0;
    for (const auto& block : blocks_)
        if (block->type == type) there_is += block->size;
    const vk::DeviceSize heap = properties_.memoryHeaps[properties_.memoryTypes[type].heapIndex].size;
    const vk::DeviceSize size =
        std::max(least, std::min({std::max(there_is, smallest), largest, heap / shares, most_}));
    auto block = std::make_unique<MemoryBlock>();
    block->type = type;
    block->size = size;
    try {
        block->memory = {device_, vk::MemoryAllocateInfo(size, type)};
    } catch (const vk::SystemError&) {
        if (size == least) throw;
        block->size = least;
        block->memory = {device_, vk::MemoryAllocateInfo(least, type)};
    }
    block->free = FreeRanges(block->size);
    blocks_.push_back(std::move(block));
    return *blocks_.back();
}

void MemoryPool::give(MemoryBlock& block, vk::DeviceSize offset, vk::DeviceSize size) noexcept
{
    const std::scoped_lock turn(turn_);
    block.free.give(offset, size);
    if (!block.free.is_whole()) return;
    const auto found = std::find_if(blocks_.begin(), blocks_.end(),
                                    [&](const auto& known) { return known.get() == &block; });
    blocks_.erase(found);
}

std::size_t MemoryPool::allocation_count() const
{
    const std::scoped_lock turn(turn_);
    return blocks_.size();
}

}  // namespace pliant::vulkan
