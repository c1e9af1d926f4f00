// `pliant view`: shows a scene in a window, or runs the same viewer without one.
#include <chrono>
#include <cstdio>
#include <iostream>
#include <limits>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "files/atomic_file.hpp"
#include "record/run_record.hpp"
#include "viewer/script.hpp"
#include "viewer/viewer.hpp"

namespace pliant::tool {
namespace {

using Clock = std::chrono::steady_clock;

/// Writes a line of JSON for each frame, with the effects of events.
class SessionLog {
public:
    explicit SessionLog(const std::string& file)
    {
        to_output_ = file == "-";
        if (!file.empty() && !to_output_) file_ = std::make_unique<AtomicFile>(file);
    }

    void add(std::uint64_t frame, Viewer& viewer)
    {
        if (!file_ && !to_output_) return;
        Session& session = viewer.session();
        Simulation& simulation = session.simulation();
        const bool idle = session.is_idle();
        if (idle) static_cast<void>(session.hold());  // all values of a line belong to one state
        const Camera camera = viewer.camera().camera();
        nlohmann::json line = {
            {"frame", frame},
            {"scene", simulation.scene().name},
            {"method", name_of(simulation.scene().method)},
            {"time", session.time()},
            {"paused", session.paused},
            {"behind", session.is_behind()},
            {"finite", session.report().finite},
            {"max_stretch", session.report().measures.max_stretch},
            {"active", session.report().solver.active_last},
            {"panel", viewer.view().panel},
            {"help", viewer.view().help},
            {"notice", session.notice},
            {"size", {viewer.screen().size().width, viewer.screen().size().height}},
            {"camera", {{"position", numbers(camera.position)}, {"target", numbers(camera.target)}}},
            {"validation_messages", viewer.screen().device()->validation_messages()}};
        line["overlays"] = nlohmann::json::array();
        for (std::size_t k = 0; k < overlay_count; ++k)
            if (viewer.view().overlays.has(static_cast<Overlay>(k)))
                line["overlays"].push_back(overlay_names[k]);
        if (idle) add_state(line, session);
        if (file_)
            file_->stream() << line.dump() << '\n';
        else
            std::cout << line.dump() << std::endl;  // flushes, so that a reader can follow the session
    }

    /// Values that are only available between steps.
    static void add_state(nlohmann::json& line, Session& session)
    {
        Simulation& simulation = session.simulation();
        line["hash"] = hash_text(simulation.state_hash());
        std::size_t pins = 0;
        for (std::size_t c = 0; c < simulation.scene().cloth_count(); ++c) pins += simulation.pins(c).size();
        line["pins"] = pins;
        const auto [centre, radius] = session.bounds();
        line["centre"] = numbers(centre);
        line["radius"] = radius;
        if (const auto& held = session.held()) {
            line["held"] = {held->cloth, held->node};
            line["held_position"] = numbers(session.position_of(*held));
            line["hand"] = numbers(session.hand());
        }
    }

    void finish()
    {
        if (file_) file_->commit();
    }

private:
    static nlohmann::json numbers(Vec3d a) { return nlohmann::json::array({a.x, a.y, a.z}); }

    std::unique_ptr<AtomicFile> file_;
    bool to_output_ = false;
};

std::unique_ptr<Screen> make_screen(const ViewOptions& options)
{
    const auto [width, height] = picture_size(options.size.empty() ? "1280x720" : options.size);
    const SimulationOptions& simulation = options.simulation;
    const vulkan::DeviceOptions device{.index = simulation.device,
                                       .validation = simulation.validation,
                                       .pipeline_folder = simulation.pipeline_folder};
    if (options.headless) return make_headless_screen(device, width, height);
    return make_window_screen(device, width, height, "pliant");
}

}  // namespace

int view_command(const ViewOptions& options)
{
    if (options.headless && !options.frames)
        throw Error(ErrorKind::bad_usage, "--headless needs --frames: without a window nothing would end it");
    std::vector<TimedEvent> script;
    if (!options.script_file.empty()) script = read_script(options.script_file);
    SessionLog log(options.log_file);
    Viewer viewer(make_screen(options), options.simulation);
    viewer.open(options.scene, options.overrides);
    viewer.session().paused = options.paused;
    if (!options.record_file.empty()) viewer.record(options.record_file);

    // With a script, or without a window, time advances by frames, so results do not depend on the machine.
    const bool by_frames = options.headless || !options.script_file.empty();
    constexpr double endless = std::numeric_limits<double>::infinity();
    constexpr double longest = 0.25;  // s
    auto next = script.begin();
    auto last = Clock::now();
    const auto start = last;
    std::uint64_t frame = 0;
    for (; !viewer.is_done() && frame < options.frames.value_or(~0ull); ++frame) {
        for (; next != script.end() && next->frame <= frame; ++next) viewer.handle(next->event);
        if (viewer.is_done()) break;
        const auto now = Clock::now();
        const double passed = std::chrono::duration<double>(now - last).count();
        last = now;
        viewer.frame(by_frames ? 1 / script_frame_rate : std::min(passed, longest), by_frames ? endless : 0);
        log.add(frame, viewer);
    }
    log.finish();
    const double wall = std::chrono::duration<double>(Clock::now() - start).count();
    const FrameCost cost = viewer.view().cost.median();
    std::printf("%llu frames in %.3g s; of a frame, steps %.3g ms, driver %.3g ms, viewer %.3g ms\n",
                static_cast<unsigned long long>(frame), wall, cost.simulation, cost.driver, cost.own);
    if (const std::uint64_t messages = viewer.screen().device()->validation_messages(); messages > 0)
        throw Error(ErrorKind::device_failure,
                    "the validation layer had " + std::to_string(messages) + " messages");
    return 0;
}

}  // namespace pliant::tool
