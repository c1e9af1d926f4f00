// An instance and its devices, from among which one is opened.
#pragma once

#include <cstdint>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "backend/vulkan/device_info.hpp"

namespace pliant::vulkan {

/// What we ask of a device; for more there are extensions that a device may lack.
constexpr std::uint32_t least_version = VK_API_VERSION_1_1;
constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

/// With drivers that are only portable to Vulkan (MoltenVK) where the loader can name these.
vk::raii::Instance make_instance(const vk::raii::Context& context, bool validation,
                                 std::vector<const char*> extensions = {});

PhysicalDeviceInfo describe(const vk::raii::PhysicalDevice& physical);
bool offers(const vk::raii::PhysicalDevice& physical, const char* extension);
/// The family with compute, and with graphics where there is one: pictures are drawn from the same queue.
/// Negative when there is none.
int best_queue_family(const vk::raii::PhysicalDevice& physical);

struct Candidate {
    vk::raii::PhysicalDevice physical;
    PhysicalDeviceInfo info;
};
/// All devices of an instance, in the loader's order; those that can be used are numbered.
std::vector<Candidate> candidates_of(const vk::raii::Instance& instance);

}  // namespace pliant::vulkan
