// The command line tool: its options and its exit codes.
#include <cstdio>
#include <exception>
#include <map>

#include <CLI/CLI.hpp>

#include "backend/vulkan/sheet_tile.hpp"
#include "bench/bench_command.hpp"
#include "commands.hpp"
#include "pliant/error.hpp"
#include "pliant/version.hpp"
#include "reproduce/reproduce_command.hpp"
#include "user_folders.hpp"

namespace {

using namespace pliant;
using namespace pliant::tool;

constexpr const char* exit_codes =
    "Exit codes: 0 good, 1 bad input, 2 bad usage, 3 the run diverged, 4 device failure, 130 ended by "
    "Ctrl-C.\n";

/// The options of a simulation's device, the same in every command.
void add_machine(CLI::App& app, SimulationOptions& options)
{
    static const std::map<std::string, Backend> backends = {{"auto", Backend::automatic},
                                                            {"cpu", Backend::cpu},
                                                            {"vulkan", Backend::vulkan},
                                                            {"reference", Backend::reference}};
    app.add_option_function<std::string>(
           "--backend",
           [&options](const std::string& name) {
               const auto found = backends.find(name);
               if (found == backends.end())
                   throw CLI::ValidationError("--backend",
                                              "'" + name + "' is none of auto, cpu, vulkan, reference");
               options.backend = found->second;
           },
           "auto (a hardware GPU if there is one, else cpu), cpu, vulkan, or reference (serial, double)")
        ->type_name("auto|cpu|vulkan|reference");
    app.add_option("--device", options.device, "Vulkan device by its number in pliant info")
        ->check(CLI::Range(0, 1000))
        ->type_name("N");
    app.add_option(
           "--threads", options.threads,
           "Threads of the cpu backend; the result does not depend on it (default: one for each core)")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    app.add_flag(
        "--fast-math", options.fast_math,
        "Explicit steps with the machine's own inverse square root and fused multiply-add: faster, but "
        "the bits then differ between machines");
    app.add_option(
           "--gpu-substeps", options.gpu_substeps,
           "Vulkan: consecutive steps of a sheet in one dispatch, 1 to 4; the result does not depend on it "
           "(default 1)")
        ->check(CLI::Range(1u, vulkan::most_sheet_steps))
        ->type_name("N");
    options.pipeline_folder = cache_folder();
    app.add_flag_callback(
        "--no-pipeline-cache", [&options] { options.pipeline_folder.clear(); },
        "Compile all shaders again, and write no compiled pipelines to the user's cache folder");
}
void add_validation(CLI::App& app, SimulationOptions& options)
{
    app.add_flag("--validation", options.validation, "Enable Vulkan's validation layer, for developers");
}

void add_run(CLI::App& app, RunOptions& options)
{
    CLI::App* run = app.add_subcommand("run", "Simulate a scene and write the requested files");
    run->footer(
        "Examples:\n"
        "  pliant run cloth_sphere --render sphere.mp4\n"
        "  pliant run hanging --set cloths[0].springs.structural.stiffness=5000 --stats hanging.csv\n"
        "  pliant run my_scene.json --backend vulkan --cache cloth.pc2 --summary cloth.json\n");
    run->add_option("scene", options.scene, "A scene file, or the name of a built-in scene (pliant list)")
        ->required()
        ->type_name("SCENE");
    add_machine(*run, options.simulation);
    run->add_option("--instruction-set", options.simulation.instruction_set,
                    "SIMD of the cpu backend: sse2, avx2 or avx512 (default: the widest of this machine)")
        ->type_name("NAME");
    run->add_option("--frames", options.frames, "Frames to simulate, instead of the scene's duration")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}))
        ->type_name("N");
    run->add_option(
           "--set", options.overrides,
           "Change a value of the scene, as in time.duration=2 or cloths[0].density=0.2; may be repeated")
        ->type_name("PATH=VALUE")
        ->allow_extra_args(false);
    const CLI::Validator file_name(
        [](const std::string& name) {
            return std::string(name.empty() ? "the name of the file is empty" : "");
        },
        "");
    run->add_option("--stats", options.statistics_file, "Per-frame statistics, CSV")
        ->type_name("F.csv")
        ->check(file_name);
    run->add_option(
           "--summary", options.summary_file,
           "Summary of the run, JSON; frames_per_second and real_time_factor exclude pictures and files")
        ->type_name("F.json")
        ->check(file_name);
    run->add_option(
           "--cache", options.cache_file,
           "Positions of every frame: x.pc2 (Blender's point cache, with x.obj beside it), seq_%04d.ply or "
           "seq_%04d.obj")
        ->check(file_name)
        ->type_name("F");
    run->add_option("--render", options.picture_files,
                    "Pictures: x.png (the last frame), frames_%04d.png or x.mp4; may be repeated")
        ->type_name("F")
        ->allow_extra_args(false);
    run->add_option("--stills", options.stills, "Six pictures spread over the run")
        ->type_name("still_%04d.png")
        ->check(file_name);
    run->add_flag("--check", options.check,
                  "Test the run against the scene's own check; exit code 1 if it fails")
        ->excludes("--frames");
    add_validation(*run, options.simulation);
    run->add_flag("--quiet", options.quiet, "Print only warnings and errors");
}

void add_bench(CLI::App& app, BenchOptions& options)
{
    CLI::App* bench = app.add_subcommand(
        "bench", "Measure steps and solvers on this machine, and compare them with baselines");
    bench->footer(
        "Examples:\n"
        "  pliant bench mss --plot steps.svg --csv steps.csv\n"
        "  pliant bench volume --threads 1 --json volume.json\n"
        "  pliant bench mss --backend vulkan --sizes 16384,262144\n"
        "  pliant bench all --quick\n"
        "A missed bar is a result, not an error: the exit code stays 0.\n");
    bench
        ->add_option("suite", options.suite,
                     "mss (mass-spring steps), constraint, acad, volume, stability or all (default)")
        ->check(CLI::IsMember({"mss", "constraint", "acad", "volume", "stability", "all"}))
        ->type_name("SUITE");
    add_machine(*bench, options.simulation);
    bench
        ->add_option("--sizes", options.sizes,
                     "Nodes of the sheets (mss, constraint) or bodies (volume), instead of each suite's own")
        ->delimiter(',')
        ->check(CLI::Range(16, 64'000'000))
        ->type_name("N,N,...");
    bench->add_option("--only", options.only, "Only cases whose name contains TEXT, such as --only hanging")
        ->type_name("TEXT");
    bench
        ->add_option(
            "--mesh", options.meshes,
            "Also measure a mesh: its linear systems (constraint), its steps as a soft body (volume); may be "
            "repeated")
        ->type_name("FILE");
    bench->add_flag("--quick", options.quick,
                    "Small cloths and few frames: a test run, without meaningful figures");
    bench->add_option("--json", options.json_file, "All rows, JSON")->type_name("F.json");
    bench->add_option("--csv", options.csv_file, "All rows, CSV")->type_name("F.csv");
    bench->add_option("--plot", options.plot_file, "Time of a step over nodes, SVG")->type_name("F.svg");
}

void add_check(CLI::App& app, CheckOptions& options)
{
    CLI::App* check =
        app.add_subcommand("check", "Describe a scene or a mesh and its defects; repair a mesh");
    check->footer(
        "Examples:\n"
        "  pliant check cloth_sphere\n"
        "  pliant check scan.stl\n"
        "  pliant check scan.stl --repair --weld 1e-5 --fill-holes --out scan.ply\n"
        "If the mesh can be read, the exit code is 0, whatever its defects.\n");
    check
        ->add_option("file", options.scene_or_mesh,
                     "A scene file, a built-in scene, or a mesh (.ply, .obj, .stl, .off, .gltf, .glb)")
        ->required()
        ->type_name("SCENE|MESH");
    check->add_option("--set", options.overrides, "Change a value of the scene, as for pliant run")
        ->type_name("PATH=VALUE")
        ->allow_extra_args(false);
    CLI::Option* repair = check->add_flag(
        "--repair", options.repair,
        "Repair a mesh: weld vertices, drop degenerate and duplicate triangles and unused vertices, "
        "make the orientation consistent and outward");
    check
        ->add_option("--weld", options.repair_options.weld_tolerance,
                     "With --repair: weld vertices this close, in m (default 0: at the same position)")
        ->check(CLI::Range(0.0, 1e4))
        ->type_name("TOLERANCE")
        ->needs(repair);
    check->add_flag("--fill-holes", options.repair_options.fill_holes, "With --repair: close boundary loops")
        ->needs(repair);
    check->add_option("--out", options.out_file, "With --repair: write the repaired mesh, .ply or .obj")
        ->type_name("FIXED.ply")
        ->needs(repair);
}

void add_info(CLI::App& app, InfoOptions& options)
{
    CLI::App* info = app.add_subcommand("info", "Backends and devices of this machine, with their limits");
    info->footer(
        "Examples:\n"
        "  pliant info --all\n"
        "  pliant info --report my_machine.json\n"
        "docs/platforms.md explains how such reports are used.\n");
    info->add_flag("--all", options.all, "Also list instruction sets that exist only for tests");
    info->add_option(
            "--report", options.report_file,
            "Run five scenes on every device and instruction set, and write their hashes and times with a "
            "description of the machine, JSON, to send in")
        ->type_name("F.json");
}

void add_reproduce(CLI::App& app, ReproduceOptions& options)
{
    CLI::App* reproduce = app.add_subcommand(
        "reproduce", "Run the experiments of both papers, and write a report that compares the results");
    reproduce->footer(
        "Examples:\n"
        "  pliant reproduce --quick\n"
        "  pliant reproduce cloth --out cloth_report --only fig07\n"
        "Writes report.html, report.md and results.csv. The same command later skips completed "
        "experiments.\n");
    reproduce->add_option("papers", options.papers, "cloth, volume or all")
        ->check(CLI::IsMember({"cloth", "volume", "all"}))
        ->type_name("PAPERS");
    reproduce->add_flag("--quick", options.quick, "Small and short: a test run in minutes");
    reproduce->add_option("--out", options.out, "Folder of the report (default: reproduction)")
        ->check(CLI::Validator(
            [](const std::string& name) {
                return std::string(name.empty() ? "the name of the folder is empty" : "");
            },
            ""))
        ->type_name("DIR");
    reproduce
        ->add_option("--only", options.only,
                     "Only experiments whose name (--list) contains TEXT; may be repeated")
        ->type_name("TEXT")
        ->allow_extra_args(false);
    reproduce
        ->add_option("--meshes", options.meshes,
                     "Folder with bunny_8k.ply, armadillo_15k.ply and spot_31k.ply; without it, generated "
                     "shapes are used")
        ->type_name("DIR");
    reproduce->add_flag("--list", options.list, "Print the names of the experiments and exit");
}

/// Options that view and render share.
void add_simulation(CLI::App& app, SimulationOptions& options, std::vector<std::string>& overrides)
{
    add_machine(app, options);
    app.add_option("--set", overrides, "Change a value of the scene, as for pliant run")
        ->type_name("PATH=VALUE")
        ->allow_extra_args(false);
    add_validation(app, options);
}

void add_view(CLI::App& app, ViewOptions& options)
{
    CLI::App* view = app.add_subcommand("view", "Show a scene in a window and interact with it");
    view->footer(
        "Examples:\n"
        "  pliant view flag\n"
        "  pliant view hanging --set method=acad --size 1920x1080\n"
        "  pliant view cloth_sphere --headless --frames 120 --script session.json --log session.jsonl\n"
        "Press F1 in the window for keys and mouse.\n");
    view->add_option("scene", options.scene, "A scene file, a built-in scene (pliant list), or a mesh")
        ->type_name("SCENE");
    add_simulation(*view, options.simulation, options.overrides);
    view->add_option("--size", options.size, "Size of the window in pixels, such as 1280x720")
        ->type_name("WxH");
    view->add_option("--frames", options.frames, "Display frames after which the viewer ends")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}))
        ->type_name("N");
    view->add_flag("--paused", options.paused, "Begin paused");
    view->add_option("--script", options.script_file,
                     "Timed events, JSON; every frame then lasts 1/60 s of simulated time")
        ->type_name("F.json");
    view->add_option("--log", options.log_file, "A line of JSON for each frame, with the state's hash")
        ->type_name("F.jsonl");
    view->add_option("--record", options.record_file, "Pictures of all frames: x.mp4 or frames_%04d.png")
        ->type_name("F");
    view->add_flag("--headless", options.headless, "Without a window; needs --frames");
}

void add_render(CLI::App& app, RenderOptions& options)
{
    CLI::App* render = app.add_subcommand("render", "Pictures and videos of a scene, with overlays");
    render->footer(
        "Examples:\n"
        "  pliant render flag --size 1920x1080 --out flag.mp4\n"
        "  pliant render hanging --overlay strain --frames 60 --out hanging.png\n"
        "  pliant render hanging --compare mass_spring,acad --overlay strain --out both.mp4\n");
    render->add_option("scene", options.scene, "A scene file, or the name of a built-in scene (pliant list)")
        ->required()
        ->type_name("SCENE");
    add_simulation(*render, options.simulation, options.overrides);
    render
        ->add_option("--out", options.out_file,
                     "x.png (the last frame), frames_%04d.png (every frame) or x.mp4")
        ->required()
        ->type_name("F");
    render
        ->add_option("--camera", options.camera,
                     "Position and target (m), and vertical field of view: X,Y,Z,TX,TY,TZ[,DEGREES]")
        ->type_name("NUMBERS");
    render
        ->add_option("--size", options.size,
                     "Size in pixels, such as 1280x720; with --compare, of both pictures together")
        ->type_name("WxH");
    render->add_option("--fps", options.frame_rate, "Pictures per second of simulated time")
        ->check(CLI::Range(1.0, 1000.0))
        ->type_name("N");
    render->add_option("--frames", options.frames, "Frames to simulate, instead of the scene's duration")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}))
        ->type_name("N");
    render
        ->add_option("--overlay", options.overlays,
                     "strain, springs, active, multipliers, contacts, normals, volume or wireframe; may be "
                     "repeated")
        ->type_name("NAME")
        ->allow_extra_args(false);
    render->add_option("--compare", options.compare, "Two methods side by side, such as mass_spring,acad")
        ->type_name("A,B");
    render->add_flag("--quiet", options.quiet, "Print only warnings and errors");
}

int dispatch(int argc, char** argv)
{
    CLI::App app("Pliant: cloth and soft bodies in real time, on any Vulkan GPU and on the CPU", "pliant");
    app.set_version_flag("--version", "pliant " PLIANT_VERSION);
    app.require_subcommand(1);
    app.footer(std::string("See 'pliant run --help' for more. ") + exit_codes);

    RunOptions run_options;
    add_run(app, run_options);
    BenchOptions bench_options;
    add_bench(app, bench_options);
    ReproduceOptions reproduce_options;
    add_reproduce(app, reproduce_options);
    app.add_subcommand("list", "The built-in scenes");
    InfoOptions info_options;
    add_info(app, info_options);
    CheckOptions check_options;
    add_check(app, check_options);
    ViewOptions view_options;
    add_view(app, view_options);
    RenderOptions render_options;
    add_render(app, render_options);

    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {
        return app.exit(success);  // --help, --version
    } catch (const CLI::ParseError& error) {
        std::string command;
        for (const CLI::App* chosen : app.get_subcommands()) command = chosen->get_name() + " ";
        std::fprintf(stderr, "pliant: %s; see 'pliant %s--help'\n", error.what(), command.c_str());
        return static_cast<int>(ErrorKind::bad_usage);
    }
    if (app.got_subcommand("run")) return run_command(run_options);
    if (app.got_subcommand("bench")) return bench_command(bench_options);
    if (app.got_subcommand("reproduce")) return reproduce_command(reproduce_options);
    if (app.got_subcommand("view")) return view_command(view_options);
    if (app.got_subcommand("render")) return render_command(render_options);
    if (app.got_subcommand("list")) return list_command();
    if (app.got_subcommand("info")) return info_command(info_options);
    return check_command(check_options);
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        const int code = dispatch(argc, argv);
        if (std::fflush(stdout) == 0) return code;
        std::fprintf(stderr, "pliant: the standard output could not be written\n");
        return static_cast<int>(pliant::ErrorKind::bad_input);
    } catch (const pliant::Error& error) {
        std::fprintf(stderr, "pliant: %s\n", error.what());
        return static_cast<int>(error.kind);
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "pliant: this machine has too little memory for the scene; use fewer nodes\n");
        return static_cast<int>(pliant::ErrorKind::device_failure);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "pliant: %s\n", error.what());
        return static_cast<int>(pliant::ErrorKind::device_failure);
    }
}
