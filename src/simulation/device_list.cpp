// What `pliant info` lists.
#include "backend/cpu/kernels.hpp"
#include "backend/vulkan/device_info.hpp"
#include "pliant/options.hpp"

namespace pliant {

std::vector<DeviceListing> list_devices()
{
    std::vector<DeviceListing> devices;
    const auto mebibytes = [](std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MiB"; };
    for (const auto& device : vulkan::list_physical_devices())
        devices.push_back({Backend::vulkan, device.index, device.name, device.kind,
                           "Vulkan " + vulkan::version_text(device.api_version) + ", memory " +
                               mebibytes(device.memory) + ", largest buffer " +
                               mebibytes(device.max_buffer_range) + ", shared memory " +
                               std::to_string(device.max_shared_memory >> 10) + " KiB; " + device.promise()});
    std::string sets;
    for (const cpu::Kernels* kernels : cpu::available_kernels())
        sets += (sets.empty() ? "" : ", ") + std::string(kernels->name);
    devices.push_back(
        {Backend::cpu, 0, "CPU", cpu::available_kernels().back()->name, "instruction sets " + sets});
    devices.push_back({Backend::reference, 0, "CPU", "serial, double", "the oracle of the tests"});
    return devices;
}

const char* name_of(Backend backend)
{
    switch (backend) {
        case Backend::automatic: return "auto";
        case Backend::cpu: return "cpu";
        case Backend::vulkan: return "vulkan";
        case Backend::reference: return "reference";
    }
    return "";
}

}  // namespace pliant
