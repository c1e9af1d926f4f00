// The Vulkan devices in a machine's report, usable or not.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "backend/vulkan/device_info.hpp"

namespace pliant::vulkan {

struct DeviceReport {
    PhysicalDeviceInfo info;
    std::string version;  ///< of Vulkan, as "1.3.239"
    std::string driver;   ///< its name and description; empty if unavailable
    std::uint32_t driver_version = 0, vendor_id = 0, device_id = 0;  ///< in Vulkan's encoding
    std::vector<std::pair<std::string, std::uint64_t>>
        limits;  ///< by their Vulkan names: those that matter to passes
};

/// Empty without a loader or driver. Never throws.
std::vector<DeviceReport> report_devices() noexcept;

}  // namespace pliant::vulkan
