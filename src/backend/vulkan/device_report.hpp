// All that a report of a machine says of its Vulkan devices, usable or not.
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
    std::string driver;   ///< its name and what it says of itself; empty where it cannot be asked
    std::uint32_t driver_version = 0, vendor_id = 0, device_id = 0;  ///< as Vulkan has them
    std::vector<std::pair<std::string, std::uint64_t>>
        limits;  ///< by Vulkan's names: those that passes may meet
};

/// Empty when there is no loader or no driver. Never throws.
std::vector<DeviceReport> report_devices() noexcept;

}  // namespace pliant::vulkan
