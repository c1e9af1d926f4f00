// `pliant check`: what is in a scene or a mesh; and the repair of a mesh.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "commands.hpp"
#include "files/atomic_file.hpp"
#include "files/numbered_name.hpp"
#include "pliant/error.hpp"
#include "pliant/mesh.hpp"

namespace pliant::tool {

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

/// What the default repair would do, and what it would leave.
void preview_repair(const SurfaceMesh& mesh)
{
    SurfaceMesh mended = mesh;
    const RepairReport report = repair_mesh(mended);
    const std::string lines = describe(report);
    std::printf("--repair would %s\n%s", lines.empty() ? "change nothing" : "do this:", lines.c_str());
    if (report.open_loops == 0) return;
    const RepairReport filled = repair_mesh(mended, {.fill_holes = true});
    const std::size_t left = filled.open_loops;
    std::printf("with --fill-holes as well:\n%s", describe(filled).c_str());
    if (left > 0) std::printf("  boundary loops left: %zu\n", left);
}

int check_mesh(const CheckOptions& options)
{
    const std::filesystem::path in = options.scene_or_mesh, out = options.out_file;
    std::error_code error;
    if (!out.empty() && std::filesystem::equivalent(in, out, error))
        throw Error(ErrorKind::bad_usage,
                    "--out " + options.out_file + " is the mesh that is read; give another name");
    SurfaceMesh mesh = read_mesh(in);
    std::printf("%s\n%s", options.scene_or_mesh.c_str(), describe(inspect_mesh(mesh)).c_str());
    if (!options.repair) {
        preview_repair(mesh);
        return 0;
    }
    const std::string lines = describe(repair_mesh(mesh, options.repair_options));
    std::printf("\n%s\n%s", lines.empty() ? "nothing to repair" : "repaired:", lines.c_str());
    if (!lines.empty()) std::printf("\n%s", describe(inspect_mesh(mesh)).c_str());
    if (out.empty()) {
        std::printf("nothing was written; --out FIXED.ply keeps the mended mesh\n");
    } else {
        write_mesh(out, mesh);
        std::printf("written: %s\n", options.out_file.c_str());
    }
    return 0;
}

}  // namespace

int check_command(const CheckOptions& options)
{
    const std::string ending = lower_case_ending(options.scene_or_mesh);
    if (ending.empty() || ending == ".json") {
        if (options.repair)
            throw Error(ErrorKind::bad_usage,
                        "--repair mends a mesh, and " + options.scene_or_mesh + " is a scene");
        return check_scene(options.scene_or_mesh, options.overrides);
    }
    if (!is_mesh_file(options.scene_or_mesh))
        throw Error(
            ErrorKind::bad_input,
            "'" + options.scene_or_mesh +
                "' is neither a scene (a name of 'pliant list', or .json) nor a mesh (.ply, .obj, .stl, "
                ".off, .gltf, .glb), by its ending");
    if (!options.overrides.empty())
        throw Error(ErrorKind::bad_usage,
                    "--set changes a scene, and " + options.scene_or_mesh + " is a mesh");
    return check_mesh(options);
}

}  // namespace pliant::tool
