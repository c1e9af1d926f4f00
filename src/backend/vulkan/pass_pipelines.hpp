// The pipelines of passes; compiling them takes its time, so that all simulations of a device share them.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "backend/vulkan/device.hpp"
#include "backend/vulkan/sheet_tile.hpp"
#include "body/cloth_model.hpp"
#include "solve/pass.hpp"

namespace pliant::vulkan {

/// As shaders/cloth.glsl.
struct Push {
    std::uint32_t index = 0, source_first = 0, source_count = 0, target_first = 0;
    std::uint32_t level = 0, detail = 0, guard = 0, slot_first = 0, slot_count = 0;
};

class PassPipelines {
public:
    PassPipelines(const Device& device, bool fast_math);

    /// Those of a device.
    static std::shared_ptr<PassPipelines> of(const Device& device, bool fast_math);

    /// Makes those that some cloths need and that are not there yet.
    void make(const Device& device, std::span<const ClothModel> models);
    /// Makes those of up to `most` steps of a sheet in a dispatch; returns how many the device can do.
    std::uint32_t make_sheet_steps(const Device& device, std::uint32_t most);

    vk::Pipeline of(const Dispatch& dispatch) const
    {
        return dispatch.steps > 1 ? *sheet_steps_[dispatch.steps].pipeline
                                  : *pipelines_[static_cast<std::size_t>(dispatch.call.pass)];
    }
    const SheetTile& tile(std::uint32_t steps) const { return sheet_steps_[steps].tile; }

    vk::raii::DescriptorSetLayout sets;
    vk::raii::PipelineLayout layout{nullptr};

private:
    struct SheetSteps {
        SheetTile tile;
        vk::raii::Pipeline pipeline{nullptr};
    };

    /// With the numbers that the shader's constants 0, 1, ... are set to.
    vk::raii::Pipeline made(const Device& device, std::span<const std::uint32_t> code,
                            std::span<const std::uint32_t> constants = {}) const;

    bool fast_math_ = false;
    std::vector<vk::raii::Pipeline> pipelines_;                 // by Pass
    std::array<SheetSteps, most_sheet_steps + 1> sheet_steps_;  // by their number, from 2 on
};

}  // namespace pliant::vulkan
