// The records of a run: per-frame statistics (CSV) and the summary (JSON).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "files/atomic_file.hpp"
#include "pliant/simulation.hpp"

namespace pliant {

/// Per-frame statistics as CSV; the header names every column with its unit. newton, iterations, residual and
/// active_constraints are those of the last step of the frame, energy_lost_J is since the start; all are 0
/// for the method mass_spring.
class StatisticsFile {
public:
    /// `bodies`: number of soft bodies; each has a column with its volume.
    explicit StatisticsFile(const std::filesystem::path& file, std::size_t bodies = 0);
    /// Adds the state after a frame; `wall_milliseconds`: time spent in its simulation.
    void add(const Report& report, double wall_milliseconds);
    void finish() { file_.commit(); }

private:
    AtomicFile file_;
};

/// Collects data for the summary beyond the last frame.
class RunSummary {
public:
    /// The state before the first step.
    void begin(const Report& report) { start_penetration_ = report.measures.max_penetration; }
    void add_frame(const Report& report);

    /// Warnings after a run, a sentence each.
    std::vector<std::string> warnings(const Simulation& simulation) const;
    /// The numbers of the summary by key; for checks and for the JSON.
    std::map<std::string, double> values(Simulation& simulation) const;
    /// Writes the summary as JSON; `wall_seconds`: duration of the whole run, including pictures and files.
    void write(const std::filesystem::path& file, Simulation& simulation, double wall_seconds) const;

    double max_stretch(double until) const;  ///< over the last simulated second
    double mean_stretch(double until) const;
    double max_stretch_peak() const { return max_stretch_peak_; }
    double max_penetration() const { return max_penetration_; }

private:
    struct FrameStretch {
        double time = 0, max = 0, mean = 0;
    };
    std::vector<FrameStretch> frames_;
    double max_stretch_peak_ = 0;
    double max_penetration_ = 0, start_penetration_ = 0;
};

/// Whether a run has diverged although its numbers are finite: a spring is a thousand times as long as at
/// rest, which no meaningful scene requires.
bool has_diverged(const FrameMeasures& measures);

/// The scene's failed checks, one sentence each; empty if all passed.
std::vector<std::string> failed_checks(const Scene& scene, const std::map<std::string, double>& values);

/// 16 hexadecimal digits.
std::string hash_text(std::uint64_t hash);

}  // namespace pliant
