#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "files/formatted.hpp"
#include "files/numbered_name.hpp"
#include "interruption.hpp"
#include "pliant/render.hpp"
#include "progress.hpp"
#include "record/cache_file.hpp"
#include "record/run_record.hpp"
#include "render/picture_recorder.hpp"
#include "stopwatch.hpp"
#include "user_folders.hpp"

namespace pliant::tool {
namespace {

std::string with_commas(std::uint64_t n)
{
    std::string text = std::to_string(n);
    for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3)
        text.insert(static_cast<std::size_t>(at), ",");
    return text;
}

/// Draws a simulation for the recorders that need pictures; frames stay on the device if the simulation is
/// there.
class Pictures {
public:
    Pictures(Simulation& simulation, const RunOptions& options, std::uint64_t frames)
        : simulation_(simulation)
    {
        for (const std::string& file : options.picture_files)
            recorders_.push_back(std::make_unique<PictureRecorder>(file, simulation.scene().time.frame_rate));
        if (!options.stills.empty()) {
            stills_ = std::make_unique<PictureRecorder>(options.stills, simulation.scene().time.frame_rate);
            constexpr std::uint64_t still_count = 6;
            for (std::uint64_t k = 0; k < still_count; ++k)
                still_frames_.push_back(k * frames / (still_count - 1));
        }
        if (recorders_.empty() && !stills_) return;
        try {
            painter_ = std::make_unique<Painter>(simulation_, PainterOptions{cache_folder()});
        } catch (const Error& error) {
            recorders_.clear();
            stills_.reset();
            refusal_ = error.what();
        }
    }

    /// Why no pictures can be drawn although some were requested; empty if they can.
    const std::string& refusal() const { return refusal_; }
    std::string device_name() const { return painter_ ? painter_->device_name() : ""; }
    double seconds() const { return seconds_; }

    /// Records the state after a frame; 0 is the start.
    void take(std::uint64_t frame, bool last)
    {
        const auto start = Clock::now();
        const bool still =
            stills_ && (last || std::count(still_frames_.begin(), still_frames_.end(), frame) > 0);
        bool wanted = still;
        for (const auto& recorder : recorders_) wanted |= recorder->wants(frame, last);
        // Diverging nodes are not visible, and software rasterisers take minutes for their triangles.
        constexpr double fastest_drawn = 1e6;  // m/s
        if (!wanted || !(simulation_.report().measures.max_speed <= fastest_drawn)) return;
        const Image& image = painter_->draw();
        for (const auto& recorder : recorders_)
            if (recorder->wants(frame, last)) recorder->add(image, frame);
        if (still) stills_->add(image, frame);
        seconds_ += seconds_since(start);
    }

    void finish()
    {
        const auto start = Clock::now();
        for (const auto& recorder : recorders_) recorder->finish();
        if (stills_) stills_->finish();
        seconds_ += seconds_since(start);
    }

private:
    Simulation& simulation_;
    std::unique_ptr<Painter> painter_;
    std::vector<std::unique_ptr<PictureRecorder>> recorders_;
    std::unique_ptr<PictureRecorder> stills_;
    std::vector<std::uint64_t> still_frames_;
    std::string refusal_;
    double seconds_ = 0;
};

/// The scene of a run, after the check that its files overwrite nothing.
Scene checked_scene(const RunOptions& options)
{
    Scene scene = read_scene(options.scene, options.overrides);
    check_outputs(options, scene);
    return scene;
}

/// One run from the first frame to the summary.
class Run {
public:
    explicit Run(const RunOptions& options)
        : options_(options),
          scene_(checked_scene(options)),
          simulation_(scene_, options.simulation),
          frames_(options.frames.value_or(static_cast<std::uint64_t>(
              std::max(1.0, std::round(scene_.time.duration * scene_.time.frame_rate))))),
          pictures_(simulation_, options, frames_)
    {
        if (!options.statistics_file.empty())
            statistics_ = std::make_unique<StatisticsFile>(options.statistics_file, simulation_.body_count());
        if (!options.cache_file.empty()) cache_ = make_cache_file(options.cache_file);
    }

    int execute()
    {
        const InterruptGuard guard;
        say_start();
        try {
            advance_all();
        } catch (...) {
            keep_what_is_complete();
            throw;
        }
        return finish();
    }

private:
    void say_start()
    {
        for (const std::string& warning : simulation_.warnings())
            std::fprintf(stderr, "warning: %s\n", warning.c_str());
        if (!pictures_.refusal().empty())
            std::fprintf(stderr, "warning: the run goes on without pictures: %s\n",
                         pictures_.refusal().c_str());
        if (options_.quiet) return;
        std::printf("%s: %s nodes, %s springs, %llu frames of %.4g ms in %u steps, on %s\n",
                    scene_.name.c_str(), with_commas(simulation_.node_count()).c_str(),
                    with_commas(simulation_.spring_count()).c_str(), static_cast<unsigned long long>(frames_),
                    1000 / scene_.time.frame_rate, simulation_.steps_per_frame(),
                    simulation_.device_name().c_str());
        std::fflush(stdout);
    }

    void advance_all()
    {
        Progress progress(frames_, options_.quiet);
        const Report& report = simulation_.report();
        summary_.begin(report);
        if (statistics_) statistics_->add(report, 0);
        if (cache_) cache_->add(simulation_, 0);
        pictures_.take(0, false);
        bool last = false;
        for (std::uint64_t frame = 1; !last; ++frame) {
            const double wall_before = report.wall_seconds;
            simulation_.advance(1 / scene_.time.frame_rate);
            if (report.device_lost) break;
            summary_.add_frame(report);
            if (statistics_) statistics_->add(report, 1000 * (report.wall_seconds - wall_before));
            if (!report.finite || has_diverged(report.measures)) break;
            if (cache_) cache_->add(simulation_, frame);
            last = frame == frames_ ||
                   InterruptGuard::signal_number() != 0;  // read once, since Ctrl-C may come at any time
            pictures_.take(frame, last);
            progress.update(frame,
                            formatted("%.3g x real time", report.simulated_seconds / report.wall_seconds));
        }
    }

    /// Completes the files of the frames so far if a run ends by an error; an error in one file does not
    /// affect the others.
    void keep_what_is_complete() noexcept
    {
        const auto attempt = [](auto&& finish_one) {
            try {
                finish_one();
            } catch (const std::exception& error) {
                std::fprintf(stderr, "warning: %s\n", error.what());
            }
        };
        attempt([&] {
            if (statistics_) statistics_->finish();
        });
        attempt([&] {
            if (cache_) cache_->finish();
        });
        attempt([&] { pictures_.finish(); });
    }

    int finish()
    {
        const Report& report = simulation_.report();
        if (report.device_lost) {
            keep_what_is_complete();
            throw Error(ErrorKind::device_failure, "the run stopped in frame " +
                                                       std::to_string(report.frames + 1) + " on " +
                                                       simulation_.device_name() + ": " + report.failure +
                                                       (simulation_.backend() == Backend::vulkan
                                                            ? "; update the driver, or run with --backend cpu"
                                                            : "; use fewer nodes or fewer steps"));
        }
        if (statistics_) statistics_->finish();
        if (cache_) cache_->finish();
        pictures_.finish();
        if (!options_.summary_file.empty())
            summary_.write(options_.summary_file, simulation_, seconds_since(start_));
        if (!report.finite || has_diverged(report.measures)) throw Error(ErrorKind::diverged, divergence());
        warn_at_end();
        if (!options_.quiet) say_end();
        const int interrupted = InterruptGuard::signal_number();
        if (interrupted)
            std::fprintf(stderr, "interrupted after frame %llu; the files are complete up to there\n",
                         static_cast<unsigned long long>(report.frames));
        return interrupted ? 128 + interrupted : check();  // the convention of shells
    }

    int check()
    {
        if (!options_.check) return 0;
        const auto failures = failed_checks(scene_, summary_.values(simulation_));
        for (const std::string& failure : failures)
            std::fprintf(stderr, "check failed: %s\n", failure.c_str());
        if (failures.empty() && !options_.quiet)
            std::printf("check: all %zu bounds of the scene hold\n", scene_.checks.size());
        return failures.empty() ? 0 : static_cast<int>(ErrorKind::bad_input);
    }

    std::string divergence() const
    {
        const Report& report = simulation_.report();
        const double frame = 1 / scene_.time.frame_rate;
        const double safe = std::min(simulation_.stable_step(), 0.5 * simulation_.step_length());
        const std::string what = report.finite
                                     ? "in frame " + std::to_string(report.frames) + " springs are " +
                                           formatted("%.3g", 1 + report.measures.max_stretch) +
                                           " times as long as at rest"
                                     : "in frame " + std::to_string(report.bad_frame) + " node " +
                                           std::to_string(report.bad_node) + " of cloth '" +
                                           scene_.cloth(report.bad_cloth).name + "' is no longer finite";
        return "the run diverged: " + what + "; take smaller steps, at least " +
               std::to_string(static_cast<long long>(std::ceil(frame / safe))) +
               " substeps per frame (--set time.substeps=N), or softer springs or heavier nodes";
    }

    void warn_at_end() const
    {
        for (const std::string& warning : summary_.warnings(simulation_))
            std::fprintf(stderr, "warning: %s\n", warning.c_str());
        const SolverReport& solver = simulation_.report().solver;
        if (solver.frames_cut > 0 && !options_.quiet)
            std::printf("%llu %s repeated in shorter steps: %llu additional steps\n",
                        static_cast<unsigned long long>(solver.frames_cut),
                        solver.frames_cut == 1 ? "frame was" : "frames were",
                        static_cast<unsigned long long>(solver.steps_added));
    }

    void say_end()
    {
        const Report& report = simulation_.report();
        const double wall = std::max(report.wall_seconds, 1e-9);
        std::printf("simulated %.4g s in %.3g s: %.4g frames/s, %.3g x real time", report.simulated_seconds,
                    wall, static_cast<double>(report.frames) / wall, report.simulated_seconds / wall);
        if (!pictures_.device_name().empty())
            std::printf("; pictures %.3g s on %s", pictures_.seconds(), pictures_.device_name().c_str());
        std::printf(
            "\nstretch at most %.3g %% in the last second, %.3g %% ever; penetration at most %.2g mm; state "
            "%s\n",
            100 * summary_.max_stretch(report.simulated_seconds), 100 * summary_.max_stretch_peak(),
            1000 * summary_.max_penetration(), hash_text(simulation_.state_hash()).c_str());
        std::vector<std::string> files;
        if (pictures_.refusal().empty()) {
            files = options_.picture_files;
            if (!options_.stills.empty()) files.push_back(options_.stills);
        }
        if (!options_.cache_file.empty()) files.push_back(options_.cache_file);
        if (lower_case_ending(options_.cache_file) == ".pc2")
            files.push_back(std::filesystem::path(options_.cache_file).replace_extension(".obj").string());
        for (const std::string& file : {options_.statistics_file, options_.summary_file})
            if (!file.empty()) files.push_back(file);
        for (const std::string& file : files) std::printf("wrote %s\n", file.c_str());
    }

    const RunOptions& options_;
    const Clock::time_point start_ = Clock::now();
    Scene scene_;
    Simulation simulation_;
    std::uint64_t frames_;
    Pictures pictures_;
    std::unique_ptr<StatisticsFile> statistics_;
    std::unique_ptr<CacheFile> cache_;
    RunSummary summary_;
};

}  // namespace

int run_command(const RunOptions& options) { return Run(options).execute(); }

}  // namespace pliant::tool
