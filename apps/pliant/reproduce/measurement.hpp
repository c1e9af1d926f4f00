// The measurements of a case.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "machine.hpp"
#include "pliant/render.hpp"

namespace pliant::tool::reproduce {

/// A run stops between two frames when this returns true.
using Interrupted = std::function<bool()>;
/// Thrown in that case: the experiment stays incomplete.
struct Interruption {};

struct Picture {
    Image image;
    std::uint64_t frame = 0;
    double time = 0;       ///< s
    bool is_last = false;  ///< the last one that could be drawn, before a wanted time: the run diverged or
                           ///< became too fast
};

/// One case on one machine.
struct Measurement {
    std::string absent;  ///< the reason if there is no measurement; the rest is then not filled
    std::uint64_t nodes = 0, springs = 0, frames = 0;
    std::uint32_t steps_per_frame = 0;
    double step = 0;  ///< s
    double frames_per_second = 0;
    bool measured = false;  ///< by Pliant, so that the following are filled
    bool finite = true;
    std::uint64_t bad_frame = 0;
    double stretch_peak = 0, stretch_last = 0;  ///< (l - l0) / l0; over the run, and in the last simulated
                                                ///< second
    VolumeReport volume;
    SolverReport solver;
    std::vector<Picture> pictures;
    double step_longest = 0;             ///< s, for the kind stability; 0: none of those tried
    bool step_longest_is_bound = false;  ///< it is the longest step tried
};

/// The scene of a case, and its overrides.
struct CaseScene {
    Scene scene;
    std::vector<std::string> overrides;
    std::string command;  ///< options of pliant run, without the backend; meshes without their folder
};
CaseScene scene_of(const Experiment& experiment, const Case& each, bool quick,
                   const std::filesystem::path& meshes);

/// Runs frames in batches, machines alternating; one entry per machine.
std::vector<Measurement> measure_speed(const Experiment& experiment, const Scene& scene, bool quick,
                                       const std::vector<MachineHere>& machines,
                                       const Interrupted& interrupted);
/// Runs frame by frame with measures, and with pictures if they can be drawn; otherwise `no_pictures` has the
/// reason.
Measurement measure_behaviour(const Experiment& experiment, const Scene& scene, bool quick,
                              const MachineHere& machine, std::string& no_pictures,
                              const Interrupted& interrupted);

/// The longest stable step of the scene, and the speed with it; one entry per machine.
std::vector<Measurement> measure_stability(const Experiment& experiment, const Scene& scene, bool quick,
                                           const std::vector<MachineHere>& machines,
                                           const Interrupted& interrupted);

/// A number in the format of all files of the report.
std::string number_text(double value);

struct Quantity {
    const char* name;  ///< name in experiments.json
    const char* title;
    const char* unit;
    /// Empty if there is no value.
    std::string (*text)(const Measurement&);
};
/// Throws Error(bad_usage) for an unknown name.
const Quantity& quantity_of(const std::string& name);

}  // namespace pliant::tool::reproduce
