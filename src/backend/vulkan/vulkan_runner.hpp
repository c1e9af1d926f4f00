// Compute shaders: programs are recorded once and replayed.
#pragma once

#include <memory>
#include <span>

#include "backend/pass_runner.hpp"
#include "backend/vulkan/device_state.hpp"

namespace pliant {

/// A runner that also gives access to its buffers for drawing.
class VulkanRunner : public PassRunner, public DeviceState {};

/// Throws Error(device_failure) if there is no such device or the cloths do not fit.
std::unique_ptr<VulkanRunner> make_vulkan_runner(std::span<const ClothModel> cloths,
                                                 const SimulationOptions& options);

}  // namespace pliant
