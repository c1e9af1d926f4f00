// The Vulkan instance and its physical devices.
#pragma once

#include <cstdint>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "backend/vulkan/device_info.hpp"

namespace pliant::vulkan {

/// The minimum version; anything beyond it is an optional extension.
constexpr std::uint32_t least_version = VK_API_VERSION_1_1;
constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

/// Includes portability drivers (MoltenVK) if the loader supports their enumeration.
vk::raii::Instance make_instance(const vk::raii::Context& context, bool validation,
                                 std::vector<const char*> extensions = {});

PhysicalDeviceInfo describe(const vk::raii::PhysicalDevice& physical);
bool offers(const vk::raii::PhysicalDevice& physical, const char* extension);
/// The queue family with compute, preferably also with graphics: pictures are drawn from the same queue.
/// Negative if there is none.
int best_queue_family(const vk::raii::PhysicalDevice& physical);

struct Candidate {
    vk::raii::PhysicalDevice physical;
    PhysicalDeviceInfo info;
};
/// All devices of an instance, in the loader's order; usable ones are numbered.
std::vector<Candidate> candidates_of(const vk::raii::Instance& instance);

}  // namespace pliant::vulkan
