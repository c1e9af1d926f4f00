#include <algorithm>
#include <cstdio>

#include "backend/cpu/kernels.hpp"
#include "backend/vulkan/device_info.hpp"
#include "commands.hpp"
#include "info_report.hpp"
#include "pliant/version.hpp"

namespace pliant::tool {

int list_command()
{
    std::size_t widest = 0;
    const auto scenes = list_scenes();
    for (const SceneListing& scene : scenes) widest = std::max(widest, scene.name.size());
    for (const SceneListing& scene : scenes)
        std::printf("%-*s  %s\n", static_cast<int>(widest), scene.name.c_str(), scene.description.c_str());
    return 0;
}

int info_command(const InfoOptions& options)
{
    if (!options.report_file.empty()) return write_machine_report(options.report_file);
    std::printf("pliant %s\n", PLIANT_VERSION);
    const auto devices = list_devices();
    for (const DeviceListing& device : devices) {
        const std::string index =
            device.backend == Backend::vulkan ? " --device " + std::to_string(device.index) : "";
        std::printf("--backend %s%s: %s (%s), %s\n", name_of(device.backend), index.c_str(),
                    device.name.c_str(), device.kind.c_str(), device.details.c_str());
    }
    if (options.all)
        for (const cpu::Kernels* kernels : cpu::test_kernels())
            std::printf("--backend cpu --instruction-set %s: only for tests, slow\n", kernels->name);
    const auto refused = vulkan::list_refused_devices();
    for (const vulkan::PhysicalDeviceInfo& device : refused)
        std::printf("refused: %s (%s): %s\n", device.name.c_str(), device.kind.c_str(),
                    device.refusal.c_str());
    const bool usable = std::any_of(devices.begin(), devices.end(), [](const DeviceListing& device) {
        return device.backend == Backend::vulkan;
    });
    if (!usable && refused.empty())
        std::printf(
            "--backend vulkan: no driver was found, so there are no pictures either; on Debian, install "
            "mesa-vulkan-drivers\n");
    return 0;
}

}  // namespace pliant::tool
