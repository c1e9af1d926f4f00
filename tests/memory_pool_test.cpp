// Memory of buffers: pieces do not overlap, come back, and many buffers are few allocations.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

#include "backend/vulkan/device.hpp"
#include "test_cloths.hpp"

namespace pliant {
namespace {

TEST(FreeRanges, AreCutWithoutOverlapAndJoinedAgain)
{
    constexpr std::uint64_t size = 1u << 16;
    vulkan::FreeRanges ranges(size);
    std::map<std::uint64_t, std::uint64_t> taken;
    std::mt19937 engine(5);
    std::size_t refused = 0;
    for (int k = 0; k < 20000; ++k) {
        if (taken.size() > 200 || (!taken.empty() && engine() % 2 == 0)) {
            auto some = std::next(taken.begin(), static_cast<std::ptrdiff_t>(engine() % taken.size()));
            ranges.give(some->first, some->second);
            taken.erase(some);
            continue;
        }
        const std::uint64_t bytes = 1 + engine() % 2000, alignment = 1u << engine() % 9;
        const auto first = ranges.take(bytes, alignment);
        if (!first) {
            ++refused;
            continue;
        }
        EXPECT_EQ(*first % alignment, 0u);
        EXPECT_LE(*first + bytes, size);
        const auto after = taken.lower_bound(*first);
        if (after != taken.end()) {
            EXPECT_LE(*first + bytes, after->first);
        }
        if (after != taken.begin()) {
            EXPECT_LE(std::prev(after)->first + std::prev(after)->second, *first);
        }
        taken[*first] = bytes;
        EXPECT_FALSE(ranges.is_whole());
    }
    EXPECT_GT(refused, 0u);  // it was full at times
    for (const auto& [first, bytes] : taken) ranges.give(first, bytes);
    EXPECT_TRUE(ranges.is_whole());
    EXPECT_EQ(ranges.take(size, 256), 0u);
    EXPECT_EQ(ranges.take(1, 1), std::nullopt);
}

TEST(DeviceMemory, HoldsManyBuffersInFewBlocksEachWithItsOwnNumbers)
{
    const vulkan::Device device({.validation = true});
    constexpr auto usage = vk::BufferUsageFlagBits::eStorageBuffer;
    const std::size_t before = device.allocation_count();
    {
        std::vector<vulkan::Buffer> buffers;
        std::vector<std::vector<std::uint32_t>> numbers;
        for (std::uint32_t k = 0; k < 600; ++k) {
            const auto memory = static_cast<vulkan::Memory>(k % 3);
            numbers.emplace_back(100 + 7 * k % 1000, k);
            const std::size_t bytes = numbers.back().size() * sizeof(std::uint32_t);
            buffers.push_back(device.make_buffer(bytes, usage, memory, "test"));
            EXPECT_EQ(buffers.back().mapped != nullptr, memory != vulkan::Memory::device);
            device.write(buffers.back(), numbers.back().data(), bytes);
            if (k % 5 == 4) {  // some go, and others come into their places
                buffers.erase(buffers.begin() + k / 10);
                numbers.erase(numbers.begin() + k / 10);
            }
        }
        EXPECT_LE(device.allocation_count(), before + 9);
        for (std::size_t k = 0; k < buffers.size(); ++k) {
            std::vector<std::uint32_t> read(numbers[k].size());
            device.read(buffers[k], read.data(), read.size() * sizeof read[0]);
            EXPECT_EQ(read, numbers[k]) << k;
        }
    }
    EXPECT_LE(device.allocation_count(), before + 2);  // what is kept for reading and writing
}

TEST(DeviceMemory, OfTwoHundredClothsIsFewAllocations)
{
    Scene scene;
    for (int k = 0; k < 200; ++k) {
        Cloth cloth =
            k % 2 == 0 ? test::flat_sheet(6, 5) : Cloth::mesh(test::irregular_mesh(5, 5), {.density = 0.3});
        cloth.springs = {{1000, 0.02}, {500, 0.03}, {10, 0.004}};
        scene.add(std::move(cloth));
    }
    scene.time.substeps = 8;
    SimulationOptions options = test::on(Backend::vulkan);
    options.shared_device = std::make_shared<vulkan::Device>(vulkan::DeviceOptions{.validation = true});
    Simulation vulkan(scene, options), cpu(scene, test::on(Backend::cpu));
    for (int frame = 0; frame < 2; ++frame) {
        vulkan.advance(1.0 / 60);
        cpu.advance(1.0 / 60);
    }
    EXPECT_EQ(vulkan.report().failure, "");
    EXPECT_EQ(vulkan.state_hash(), cpu.state_hash());
    EXPECT_LE(options.shared_device->allocation_count(), 16u);  // of some thousand buffers
}

}  // namespace
}  // namespace pliant
