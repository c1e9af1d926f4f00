#include "backend/vulkan/device_report.hpp"

#include "backend/vulkan/physical_devices.hpp"

namespace pliant::vulkan {
namespace {

std::string driver_of(const vk::raii::PhysicalDevice& physical, std::uint32_t version)
{
    if (version < VK_API_VERSION_1_2 &&
        (version < least_version || !offers(physical, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME)))
        return "";
    const auto driver =
        physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>()
            .get<vk::PhysicalDeviceDriverProperties>();
    return std::string(driver.driverName.data()) + " " + driver.driverInfo.data();
}

DeviceReport report_of(const Candidate& candidate)
{
    const auto properties = candidate.physical.getProperties();
    const vk::PhysicalDeviceLimits& limits = properties.limits;
    DeviceReport report;
    report.info = candidate.info;
    report.version = version_text(properties.apiVersion) + "." +
                     std::to_string(VK_API_VERSION_PATCH(properties.apiVersion));
    report.driver = driver_of(candidate.physical, properties.apiVersion);
    report.driver_version = properties.driverVersion;
    report.vendor_id = properties.vendorID;
    report.device_id = properties.deviceID;
#define LIMIT(name) {#name, limits.name}
    report.limits = {LIMIT(maxPerStageDescriptorStorageBuffers),
                     LIMIT(maxPerStageDescriptorUniformBuffers),
                     LIMIT(maxPerStageResources),
                     LIMIT(maxDescriptorSetStorageBuffers),
                     LIMIT(maxDescriptorSetUniformBuffers),
                     LIMIT(maxBoundDescriptorSets),
                     LIMIT(maxStorageBufferRange),
                     LIMIT(maxUniformBufferRange),
                     LIMIT(minStorageBufferOffsetAlignment),
                     LIMIT(maxPushConstantsSize),
                     LIMIT(maxMemoryAllocationCount),
                     LIMIT(maxComputeSharedMemorySize),
                     LIMIT(maxComputeWorkGroupInvocations)};
#undef LIMIT
    report.limits.emplace_back("maxMemoryAllocationSize", candidate.info.max_allocation);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string index = "[" + std::to_string(axis) + "]";
        report.limits.emplace_back("maxComputeWorkGroupSize" + index, limits.maxComputeWorkGroupSize[axis]);
        report.limits.emplace_back("maxComputeWorkGroupCount" + index, limits.maxComputeWorkGroupCount[axis]);
    }
    return report;
}

}  // namespace

std::vector<DeviceReport> report_devices() noexcept
{
    std::vector<DeviceReport> reports;
    try {
        const vk::raii::Context context;
        const auto instance = make_instance(context, false);
        for (const Candidate& candidate : candidates_of(instance)) reports.push_back(report_of(candidate));
    } catch (const std::exception&) {
        reports.clear();  // no loader or driver: no devices
    }
    return reports;
}

}  // namespace pliant::vulkan
