// The pipelines of passes. Compiling them takes long, so all simulations of a device share them, and each is
// made only when a program needs it.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "backend/vulkan/bindings.hpp"
#include "backend/vulkan/device.hpp"
#include "backend/vulkan/sheet_tile.hpp"
#include "solve/pass.hpp"

namespace pliant::vulkan {

/// Thread-safe.
class PassPipelines {
public:
    PassPipelines(const Device& device, bool fast_math);

    /// The pipelines of a device.
    static std::shared_ptr<PassPipelines> of(const Device& device, bool fast_math);

    /// Makes the missing pipelines of some dispatches. Throws Error(device_failure) if one exceeds the
    /// device's limits.
    void make(const Device& device, std::span<const Dispatch> dispatches);
    /// How many have been made.
    std::size_t made_count() const;

    /// The pipeline of a dispatch that was passed to `make`.
    vk::Pipeline of(const Dispatch& dispatch) const;
    /// How many steps of a sheet, up to `most`, the device can make in one dispatch.
    std::uint32_t sheet_steps(std::uint32_t most) const;
    const SheetTile& tile(std::uint32_t steps) const { return tiles_[steps]; }

    /// By layout.
    std::span<const vk::raii::DescriptorSetLayout> sets() const { return sets_; }
    vk::PipelineLayout layout(PassLayout layout) const { return *layouts_[static_cast<std::size_t>(layout)]; }

private:
    static std::size_t place_of(const Dispatch& dispatch);
    vk::raii::Pipeline made(const Device& device, const Dispatch& dispatch) const;

    bool fast_math_ = false;
    std::vector<vk::raii::DescriptorSetLayout> sets_;
    std::vector<vk::raii::PipelineLayout> layouts_;
    std::array<SheetTile, most_sheet_steps + 1> tiles_;  // by the number of steps, from 2 on
    std::vector<vk::raii::Pipeline> pipelines_;          // by Pass, then by the number of steps
    mutable std::mutex turn_;                            // guards pipelines_
};

}  // namespace pliant::vulkan
