#include "measurement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pliant/error.hpp"
#include "pliant/render.hpp"
#include "record/run_record.hpp"
#include "user_folders.hpp"

namespace pliant::tool::reproduce {
namespace {

constexpr std::uint32_t picture_width = 320, picture_height = 240;  // pixels
// Later frames of a diverging run show nothing, so drawing stops at this speed.
constexpr double fastest_drawn = 60;  // m/s
constexpr int batches = 5;

std::string json_number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string quoted_for_shell(const std::string& text)
{
    return text.find_first_of(" \"'[]{}") == std::string::npos ? text : "'" + text + "'";
}

/// Overrides for a body's height above the ground and its size.
std::vector<std::string> placement(const Experiment& experiment, const Case& each, const Scene& scene)
{
    const auto* mesh = std::get_if<SurfaceMesh>(&scene.cloth(0).shape);
    if (!mesh || (!experiment.rest_above && !each.mesh_height)) return {};
    float lowest = mesh->vertices.front().y, highest = lowest;
    for (const Vec3& vertex : mesh->vertices) {
        lowest = std::min(lowest, vertex.y);
        highest = std::max(highest, vertex.y);
    }
    std::vector<std::string> overrides;
    double scale = scene.cloth(0).scale;
    if (each.mesh_height) {
        scale = *each.mesh_height / (static_cast<double>(highest) - static_cast<double>(lowest));
        overrides.push_back("bodies[0].mesh.scale=" + json_number(scale));
        // As high above the lower plate as the scene's own figure.
        constexpr double gap = 0.005;  // m
        overrides.push_back("bodies[0].position=[0, " +
                            json_number(gap - scale * static_cast<double>(lowest)) + ", 0]");
    }
    if (experiment.rest_above)
        overrides.push_back("bodies[0].position=[0, " +
                            json_number(*experiment.rest_above - scale * static_cast<double>(lowest)) +
                            ", 0]");
    return overrides;
}

void describe(Measurement& m, const Simulation& simulation)
{
    m.nodes = simulation.node_count();
    m.springs = simulation.spring_count();
    m.steps_per_frame = simulation.steps_per_frame();
    m.step = simulation.step_length();
}

void take(Measurement& m, const Simulation& simulation, const RunSummary& summary)
{
    const Report& report = simulation.report();
    if (report.device_lost) throw Error(ErrorKind::device_failure, report.failure);
    describe(m, simulation);
    m.measured = true;
    m.finite = report.finite;
    m.bad_frame = report.bad_frame;
    m.stretch_peak = summary.max_stretch_peak();
    m.stretch_last = summary.max_stretch(report.simulated_seconds);
    m.volume = report.volume;
    m.solver = report.solver;
}

double node_count_of(const Scene& scene)
{
    double count = 0;
    for (std::size_t c = 0; c < scene.cloth_count(); ++c) {
        if (const auto* sheet = std::get_if<SheetOptions>(&scene.cloth(c).shape))
            count += static_cast<double>(sheet->rows) * sheet->columns;
        else if (const auto* mesh = std::get_if<SurfaceMesh>(&scene.cloth(c).shape))
            count += static_cast<double>(mesh->vertices.size());
    }
    return count;
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n == 0 ? 0 : (values[(n - 1) / 2] + values[n / 2]) / 2;
}

/// One machine in a speed measurement.
struct Lane {
    std::unique_ptr<Stepper> stepper;
    std::vector<double> seconds_per_frame;
    std::uint64_t batch = 0, frames = 0;
    double spent = 0;
    RunSummary summary;
};

void advance(Lane& lane, std::uint64_t call, const Interrupted& interrupted)
{
    double seconds = 0;
    for (std::uint64_t done = 0; done < lane.batch;) {
        if (interrupted()) throw Interruption{};
        const std::uint64_t count = std::min(call == 0 ? lane.batch : call, lane.batch - done);
        seconds += lane.stepper->advance(count);
        done += count;
        if (Simulation* simulation = lane.stepper->simulation()) lane.summary.add_frame(simulation->report());
    }
    lane.frames += lane.batch;
    lane.spent += seconds;
    lane.seconds_per_frame.push_back(seconds / static_cast<double>(lane.batch));
}

/// Sets up a lane, warms it up, and determines how many frames fit into the time.
void prepare(Lane& lane, const Experiment& experiment, const Scene& scene, bool quick,
             const MachineHere& machine, const Interrupted& interrupted)
{
    lane.stepper = make_stepper(scene, machine);
    lane.batch = 1;
    advance(lane, experiment.batch, interrupted);  // makes programs
    lane.seconds_per_frame.clear();
    lane.frames = 0;
    lane.spent = 0;
    const double one = std::max(lane.stepper->advance(1), 1e-7);
    const double affordable = experiment.seconds.of(quick) / one / batches;
    lane.batch = static_cast<std::uint64_t>(
        std::clamp(affordable, 1.0, std::max(experiment.frames.of(quick) / batches, 1.0)));
    // Makes the program of a longer call before it is timed.
    if (experiment.batch == 0 && lane.batch > 1 && machine.machine != Machine::serial)
        lane.stepper->advance(lane.batch);
}

}  // namespace

CaseScene scene_of(const Experiment& experiment, const Case& each, bool quick,
                   const std::filesystem::path& meshes)
{
    CaseScene made;
    made.overrides = each.set;
    const auto add = [&](const std::string& override_text) { made.overrides.push_back(override_text); };
    if (!each.mesh.empty())
        add("bodies[0].mesh.file=\"" + std::filesystem::absolute(meshes / each.mesh).string() + "\"");
    made.scene = read_scene(experiment.scene, made.overrides);
    const auto more = placement(experiment, each, made.scene);
    if (!more.empty()) {
        made.overrides.insert(made.overrides.end(), more.begin(), more.end());
        made.scene = read_scene(experiment.scene, made.overrides);
    }
    made.scene.camera.width = picture_width;
    made.scene.camera.height = picture_height;

    made.command = "pliant run " + experiment.scene;
    for (const std::string& text : made.overrides) {
        const bool is_mesh = text.rfind("bodies[0].mesh.file=", 0) == 0;
        made.command += " --set " + quoted_for_shell(is_mesh ? "bodies[0].mesh.file=" + each.mesh : text);
    }
    made.command += " --frames " + number_text(experiment.frames.of(quick));
    return made;
}

std::vector<Measurement> measure_speed(const Experiment& experiment, const Scene& scene, bool quick,
                                       const std::vector<MachineHere>& machines,
                                       const Interrupted& interrupted)
{
    std::vector<Measurement> measurements(machines.size());
    std::vector<Lane> lanes(machines.size());
    const double budget = experiment.seconds.of(quick);
    for (std::size_t k = 0; k < machines.size(); ++k) {
        if (machines[k].software && node_count_of(scene) > experiment.software_nodes.of(quick)) {
            measurements[k].absent = "larger cases are left out on a software device";
            continue;
        }
        try {
            prepare(lanes[k], experiment, scene, quick, machines[k], interrupted);
        } catch (const Error& error) {  // for example a device that is too small: the others continue
            lanes[k].stepper.reset();
            measurements[k].absent = error.what();
        }
    }
    for (int batch = 0; batch < batches; ++batch)
        for (Lane& lane : lanes) {
            if (!lane.stepper) continue;
            if (batch > 0 && lane.spent > budget) continue;
            advance(lane, experiment.batch, interrupted);
        }
    for (std::size_t k = 0; k < machines.size(); ++k) {
        Lane& lane = lanes[k];
        if (!lane.stepper) continue;
        Measurement& m = measurements[k];
        if (Simulation* simulation = lane.stepper->simulation()) try {
                take(m, *simulation, lane.summary);
            } catch (const Error& error) {
                m.absent = error.what();
                continue;
            }
        m.frames = lane.frames;
        m.frames_per_second = 1 / std::max(median(lane.seconds_per_frame), 1e-12);
        if (!m.finite) m.absent = "diverged in frame " + std::to_string(m.bad_frame);
    }
    return measurements;
}

Measurement measure_behaviour(const Experiment& experiment, const Scene& scene, bool quick,
                              const MachineHere& machine, std::string& no_pictures,
                              const Interrupted& interrupted)
{
    Measurement m;
    Simulation simulation(scene, machine.options);
    const auto frames = static_cast<std::uint64_t>(experiment.frames.of(quick));
    const double frame_length = 1 / scene.time.frame_rate;
    std::vector<std::uint64_t> wanted;
    for (const double time : experiment.picture_times[quick ? 1 : 0])
        wanted.push_back(std::min(frames, static_cast<std::uint64_t>(std::llround(time / frame_length))));
    std::unique_ptr<Painter> painter;
    if (!wanted.empty() && no_pictures.empty()) try {
            painter = std::make_unique<Painter>(simulation, PainterOptions{cache_folder()});
        } catch (const Error& error) {
            no_pictures = error.what();
        }

    RunSummary summary;
    std::uint64_t calm = 0, drawn = 0;  // last frame that could be drawn; number of pictures so far
    const auto take_pictures = [&](std::uint64_t frame) {
        for (const std::uint64_t each : wanted)
            if (painter && each == frame) {
                m.pictures.push_back({painter->draw(), frame, simulation.time(), false});
                ++drawn;
            }
    };
    for (std::uint64_t frame = 1; frame <= frames; ++frame) {
        if (interrupted()) throw Interruption{};
        simulation.advance(frame_length);
        summary.add_frame(simulation.report());
        m.frames = frame;
        if (!simulation.report().finite) break;
        const bool can_be_drawn = simulation.report().measures.max_speed < fastest_drawn;
        if (can_be_drawn && calm + 1 == frame) calm = frame;
        if (can_be_drawn) take_pictures(frame);
    }
    take(m, simulation, summary);
    m.frames_per_second = static_cast<double>(m.frames) / std::max(simulation.report().wall_seconds, 1e-9);

    if (painter && drawn < wanted.size()) {  // repeats the run up to the last frame that could be drawn
        Simulation again(scene, machine.options);
        for (std::uint64_t frame = 1; frame <= calm; ++frame) again.advance(frame_length);
        Painter last(again);
        m.pictures.push_back({last.draw(), calm, again.time(), true});
    }
    return m;
}

}  // namespace pliant::tool::reproduce
