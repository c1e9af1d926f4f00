#include <algorithm>
#include <cmath>
#include <cstdio>

#include "commands.hpp"
#include "files/numbered_name.hpp"
#include "pliant/mesh.hpp"
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

int info_command()
{
    std::printf("pliant %s\n", PLIANT_VERSION);
    const auto devices = list_devices();
    for (const DeviceListing& device : devices) {
        const std::string index =
            device.backend == Backend::vulkan ? " --device " + std::to_string(device.index) : "";
        std::printf("--backend %s%s: %s (%s), %s\n", name_of(device.backend), index.c_str(),
                    device.name.c_str(), device.kind.c_str(), device.details.c_str());
    }
    const bool vulkan = std::any_of(devices.begin(), devices.end(), [](const DeviceListing& device) {
        return device.backend == Backend::vulkan;
    });
    if (!vulkan)
        std::printf(
            "--backend vulkan: no driver was found, so there are no pictures either; on Debian, install "
            "mesa-vulkan-drivers\n");
    return 0;
}

namespace {

int check_scene(const std::string& name, const std::vector<std::string>& overrides)
{
    const Scene scene = read_scene(name, overrides);
    SimulationOptions options;
    options.backend = Backend::cpu;
    Simulation simulation(scene, options);
    std::printf("%s: %s\n", scene.name.c_str(), scene.description.c_str());
    std::printf("  cloths %zu, nodes %llu, springs %llu, triangles %llu, colliders %zu\n",
                scene.cloth_count(), static_cast<unsigned long long>(simulation.node_count()),
                static_cast<unsigned long long>(simulation.spring_count()),
                static_cast<unsigned long long>(simulation.triangle_count()), scene.colliders.size());
    std::printf("  %.4g s in frames of %.4g ms, %u steps of %.4g ms each\n", scene.time.duration,
                1000 / scene.time.frame_rate, simulation.steps_per_frame(), 1000 * simulation.step_length());
    if (std::isfinite(simulation.stable_step()))
        std::printf("  the largest step that is certainly stable is %.4g ms\n",
                    1000 * simulation.stable_step());
    const std::string warning = simulation.stability_warning();
    std::printf("%s\n", warning.empty() ? "the scene is good" : ("warning: " + warning).c_str());
    return 0;
}

}  // namespace

int check_command(const std::string& scene_or_mesh, const std::vector<std::string>& overrides)
{
    const std::string ending = lower_case_ending(scene_or_mesh);
    if (ending.empty() || ending == ".json") return check_scene(scene_or_mesh, overrides);
    if (ending != ".ply" && ending != ".obj")
        throw Error(ErrorKind::bad_input, "'" + scene_or_mesh +
                                              "' is neither a scene (a name of 'pliant list', or .json) nor "
                                              "a mesh (.ply, .obj), by its ending");
    if (!overrides.empty())
        throw Error(ErrorKind::bad_usage, "--set changes a scene, and " + scene_or_mesh + " is a mesh");
    std::printf("%s\n%s", scene_or_mesh.c_str(), describe(inspect_mesh(read_mesh(scene_or_mesh))).c_str());
    return 0;
}

}  // namespace pliant::tool
