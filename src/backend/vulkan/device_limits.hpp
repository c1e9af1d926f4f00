// Compares the requirements of passes with a device's limits. A device or pipeline that does not fit is
// refused with a sentence that names the limit.
#pragma once

#include <cstdint>
#include <string>

#include <vulkan/vulkan.hpp>

#include "backend/vulkan/bindings.hpp"
#include "backend/vulkan/shader_needs.hpp"
#include "pliant/api.hpp"

namespace pliant::vulkan {

/// Buffers in the layout of a pipeline: devices count these, whether used or not.
struct LayoutNeeds {
    std::uint32_t storage_buffers = 0, uniform_buffers = 0;
};
LayoutNeeds needs_of(PassLayout layout);

/// The first limit of `device` that a pipeline exceeds, as the rest of a sentence after "it cannot run NAME:
/// ". Empty if there is none.
PLIANT_INSIDE std::string beyond_limits(const vk::PhysicalDeviceLimits& device, const ShaderNeeds& shader,
                                        const LayoutNeeds& layout);

/// The same for all passes, with the name of the pass first. Dispatches of several steps adapt to the limits
/// instead (sheet_tile.hpp).
std::string passes_beyond_limits(const vk::PhysicalDeviceLimits& device);

}  // namespace pliant::vulkan
