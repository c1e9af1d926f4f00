// `pliant check`: the contents of a scene or a mesh, and the repair of a mesh.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "body/stepping_plan.hpp"
#include "commands.hpp"
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
    // Implicit steps are stable at any length.
    if (stepped_method(scene) != Method::constraint && std::isfinite(simulation.stable_step()))
        std::printf("  the largest step that is certainly stable is %.4g ms\n",
                    1000 * simulation.stable_step());
    const std::vector<std::string> warnings = simulation.warnings();
    for (const std::string& warning : warnings) std::printf("warning: %s\n", warning.c_str());
    if (warnings.empty()) std::printf("the scene is good\n");
    return 0;
}

/// Whether the mesh could be a body with volume, and what is missing.
std::string state_of(const SurfaceMesh& mesh)
{
    const MeshReport report = inspect_mesh(mesh);
    if (report.closed && report.oriented) {
        char volume[64];
        std::snprintf(volume, sizeof volume, "%.6g", report.volume);
        return "closed, with a volume of " + std::string(volume) + " m^3";
    }
    return report.boundary_loops > 0
               ? "open, with " + std::to_string(report.boundary_loops) + " boundary loops"
               : "not closed";
}

/// What the default repair would change, and what filling holes would add.
void preview_repair(SurfaceMesh mesh)
{
    const RepairReport report = repair_mesh(mesh);
    const std::string lines = describe(report);
    if (lines.empty())
        std::printf("--repair would change nothing\n");
    else
        std::printf("--repair would do this, after which the mesh is %s:\n%s", state_of(mesh).c_str(),
                    lines.c_str());
    if (report.open_loops == 0) return;
    const std::string filled = describe(repair_mesh(mesh, {.fill_holes = true}));
    if (!filled.empty())
        std::printf("--fill-holes would do this as well, after which it is %s:\n%s", state_of(mesh).c_str(),
                    filled.c_str());
}

int check_mesh(const CheckOptions& options)
{
    const std::filesystem::path in = options.scene_or_mesh, out = options.out_file;
    std::error_code error;
    if (!out.empty() && std::filesystem::equivalent(in, out, error))
        throw Error(ErrorKind::bad_usage,
                    "--out " + options.out_file + " is the mesh that is read; give another name");
    SurfaceMesh mesh = read_mesh(in);
    std::string text = options.scene_or_mesh + "\n" + describe(inspect_mesh(mesh));
    if (options.repair) {
        const std::string lines = describe(repair_mesh(mesh, options.repair_options));
        text += lines.empty() ? "\nnothing to repair\n"
                              : "\nrepaired:\n" + lines + "\n" + describe(inspect_mesh(mesh));
        if (!out.empty()) write_mesh(out, mesh);  // before anything is printed, since it may fail
        text += out.empty() ? "nothing was written; use --out FIXED.ply to write the repaired mesh\n"
                            : "written: " + options.out_file + "\n";
    }
    std::fputs(text.c_str(), stdout);
    if (!options.repair) preview_repair(mesh);
    return 0;
}

}  // namespace

int check_command(const CheckOptions& options)
{
    const std::string ending = lower_case_ending(options.scene_or_mesh);
    if (ending.empty() || ending == ".json") {
        if (options.repair)
            throw Error(ErrorKind::bad_usage,
                        "--repair is for a mesh, and " + options.scene_or_mesh + " is a scene");
        return check_scene(options.scene_or_mesh, options.overrides);
    }
    if (!is_mesh_file(options.scene_or_mesh))
        throw Error(
            ErrorKind::bad_input,
            "'" + options.scene_or_mesh +
                "' is neither a scene (a name of 'pliant list', or .json) nor a mesh (.ply, .obj, .stl, "
                ".off, .gltf, .glb), by its extension");
    if (!options.overrides.empty())
        throw Error(ErrorKind::bad_usage,
                    "--set is for a scene, and " + options.scene_or_mesh + " is a mesh");
    return check_mesh(options);
}

}  // namespace pliant::tool
