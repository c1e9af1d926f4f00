// The Vulkan devices of a machine: which can run the passes, which cannot and why.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "backend/vulkan/shader_code.hpp"

namespace pliant::vulkan {

constexpr const char* equal_bits = "equal bits on all machines";

/// A version of Vulkan as people write it: 1.1.
std::string version_text(std::uint32_t version);

/// What `pliant info` shows of a physical device.
struct PhysicalDeviceInfo {
    int index = -1;  ///< among those that can be used
    std::string name;
    std::string kind;  ///< "discrete GPU", "integrated GPU", "virtual GPU", "software", "other"
    bool hardware = false;
    std::uint32_t api_version = 0;
    std::uint64_t memory = 0;             ///< bytes, the largest device-local heap
    std::uint64_t max_buffer_range = 0;   ///< bytes of one storage buffer
    std::uint64_t max_allocation = 0;     ///< bytes of one piece of memory
    std::uint32_t max_shared_memory = 0;  ///< bytes
    FloatControls float_controls;         ///< execution modes that it offers
    std::string refusal;                  ///< why it cannot be used, a sentence; empty when it can

    /// Whether a run gives the bits of all other machines, or why that is not promised.
    std::string promise() const;
};

/// Devices that can run the passes; empty when there is no loader or no driver. Never throws.
std::vector<PhysicalDeviceInfo> list_physical_devices() noexcept;
/// Those that cannot, each with its reason. Never throws.
std::vector<PhysicalDeviceInfo> list_refused_devices() noexcept;

}  // namespace pliant::vulkan
