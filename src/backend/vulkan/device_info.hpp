// The Vulkan devices of a machine: which can run the passes, and why others cannot.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "backend/vulkan/shader_code.hpp"

namespace pliant::vulkan {

constexpr const char* equal_bits = "equal bits on all machines";

/// A version of Vulkan as text, such as 1.1.
std::string version_text(std::uint32_t version);

/// The data of a physical device for `pliant info`.
struct PhysicalDeviceInfo {
    int index = -1;  ///< among the usable devices
    std::string name;
    std::string kind;  ///< "discrete GPU", "integrated GPU", "virtual GPU", "software", "other"
    bool hardware = false;
    std::uint32_t api_version = 0;
    std::uint64_t memory = 0;             ///< bytes, the largest device-local heap
    std::uint64_t max_buffer_range = 0;   ///< bytes of one storage buffer
    std::uint64_t max_allocation = 0;     ///< bytes of one piece of memory
    std::uint32_t max_shared_memory = 0;  ///< bytes
    FloatControls float_controls;         ///< execution modes that it supports
    std::string refusal;                  ///< why it cannot be used, a sentence; empty if it can

    /// Says that a run gives the same bits as on all machines, or why that is not promised.
    std::string promise() const;
};

/// Devices that can run the passes; empty without a loader or driver. Never throws.
std::vector<PhysicalDeviceInfo> list_physical_devices() noexcept;
/// Devices that cannot, each with its reason. Never throws.
std::vector<PhysicalDeviceInfo> list_refused_devices() noexcept;

}  // namespace pliant::vulkan
