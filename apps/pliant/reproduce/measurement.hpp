// What is measured of a case.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "machine.hpp"
#include "pliant/render.hpp"

namespace pliant::tool::reproduce {

/// A run is given up between two frames when this answers true.
using Interrupted = std::function<bool()>;
/// Thrown when it did: the experiment is left undone.
struct Interruption {};

struct Picture {
    Image image;
    std::uint64_t frame = 0;
    double time = 0;       ///< s
    bool is_last = false;  ///< that could be drawn, before a wanted time: the run diverged, or went too fast
};

/// One case on one machine.
struct Measurement {
    std::string absent;  ///< why there is none; the rest is then not filled
    std::uint64_t nodes = 0, springs = 0, frames = 0;
    std::uint32_t steps_per_frame = 0;
    double step = 0;  ///< s
    double frames_per_second = 0;
    bool measured = false;  ///< by Pliant, so that what follows is there
    bool finite = true;
    std::uint64_t bad_frame = 0;
    double stretch_peak = 0, stretch_last = 0;  ///< (l - l0) / l0; ever, and in the last simulated second
    VolumeReport volume;
    SolverReport solver;
    std::vector<Picture> pictures;
    double step_longest = 0;             ///< s, of kind stability; 0: none that was tried
    bool step_longest_is_bound = false;  ///< the longest that is tried at all
};

/// The scene of a case, and the overrides that make it.
struct CaseScene {
    Scene scene;
    std::vector<std::string> overrides;
    std::string
        command;  ///< with which pliant run makes it, but for the backend; meshes without their folder
};
CaseScene scene_of(const Experiment& experiment, const Case& each, bool quick,
                   const std::filesystem::path& meshes);

/// Frames in batches, the machines in turn; one entry for each machine.
std::vector<Measurement> measure_speed(const Experiment& experiment, const Scene& scene, bool quick,
                                       const std::vector<MachineHere>& machines,
                                       const Interrupted& interrupted);
/// Frame by frame with measures, and pictures when they can be drawn here; else `no_pictures` says why not.
Measurement measure_behaviour(const Experiment& experiment, const Scene& scene, bool quick,
                              const MachineHere& machine, std::string& no_pictures,
                              const Interrupted& interrupted);

/// The longest step that the scene stands, and the speed with it; one entry for each machine.
std::vector<Measurement> measure_stability(const Experiment& experiment, const Scene& scene, bool quick,
                                           const std::vector<MachineHere>& machines,
                                           const Interrupted& interrupted);

/// A number as every file of the report writes it.
std::string number_text(double value);

struct Quantity {
    const char* name;  ///< in experiments.json
    const char* title;
    const char* unit;
    /// Empty when there is none.
    std::string (*text)(const Measurement&);
};
/// Throws Error(bad_usage) for a name that experiments.json should not have.
const Quantity& quantity_of(const std::string& name);

}  // namespace pliant::tool::reproduce
