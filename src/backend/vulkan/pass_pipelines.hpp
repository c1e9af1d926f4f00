// The pipelines of passes; compiling them takes its time, so that all simulations of a device share them, and
// only those are made that a program names.
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

/// Threads may share it.
class PassPipelines {
public:
    PassPipelines(const Device& device, bool fast_math);

    /// Those of a device.
    static std::shared_ptr<PassPipelines> of(const Device& device, bool fast_math);

    /// Makes those of some dispatches that are not there yet. Throws Error(device_failure) where one is
    /// beyond the limits of the device.
    void make(const Device& device, std::span<const Dispatch> dispatches);
    /// How many have been made.
    std::size_t made_count() const;

    /// Of a dispatch that `make` has seen.
    vk::Pipeline of(const Dispatch& dispatch) const;
    /// How many steps of a sheet the device can make in a dispatch, `most` at most.
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
    mutable std::mutex turn_;                            // of pipelines_
};

}  // namespace pliant::vulkan
