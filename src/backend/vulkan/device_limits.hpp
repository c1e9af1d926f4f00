// What passes ask of a device, against what it offers: a device or a pipeline that does not fit is refused
// with a sentence that names the limit.
#pragma once

#include <cstdint>
#include <string>

#include <vulkan/vulkan.hpp>

#include "backend/vulkan/bindings.hpp"
#include "backend/vulkan/shader_needs.hpp"
#include "pliant/api.hpp"

namespace pliant::vulkan {

/// Buffers in the layout of a pipeline: devices count these, used or not.
struct LayoutNeeds {
    std::uint32_t storage_buffers = 0, uniform_buffers = 0;
};
LayoutNeeds needs_of(PassLayout layout);

/// The first limit of `device` that a pipeline is beyond: the rest of a sentence after "it cannot run NAME:
/// ". Empty when there is none.
PLIANT_INSIDE std::string beyond_limits(const vk::PhysicalDeviceLimits& device, const ShaderNeeds& shader,
                                        const LayoutNeeds& layout);

/// The same of all passes, beginning with which one; of them, those of several steps in a dispatch fit to
/// what there is (sheet_tile.hpp).
std::string passes_beyond_limits(const vk::PhysicalDeviceLimits& device);

}  // namespace pliant::vulkan
