// The sub-commands of `pliant`. Each returns the exit code: 0 good, 1 bad input, 2 bad usage, 3 diverged, 4
// device failure; they may also throw pliant::Error.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pliant/simulation.hpp"

namespace pliant::tool {

struct RunOptions {
    std::string scene;
    SimulationOptions simulation;
    std::optional<std::uint64_t> frames;  ///< instead of the scene's duration
    std::vector<std::string> overrides;   ///< path=value
    std::string statistics_file, summary_file, cache_file;
    std::vector<std::string> picture_files;
    std::string stills;  ///< pattern for a few pictures over the run
    bool check = false;  ///< test the run against the scene's own check
    bool quiet = false;
};

/// Checks that no output of a run overwrites another, or an input; throws Error(bad_usage) that names both.
void check_outputs(const RunOptions& options, const Scene& scene);

int run_command(const RunOptions& options);
int list_command();

struct InfoOptions {
    bool all = false;         ///< also what exists only for tests
    std::string report_file;  ///< empty: none
};
int info_command(const InfoOptions& options);

struct CheckOptions {
    std::string scene_or_mesh;
    std::vector<std::string> overrides;  ///< path=value, of a scene
    bool repair = false;                 ///< a mesh, by `repair_options`
    RepairOptions repair_options;
    std::string out_file;  ///< for the repaired mesh; empty: not written
};
int check_command(const CheckOptions& options);

struct ViewOptions {
    std::string scene = "cloth_sphere";  ///< or a mesh
    SimulationOptions simulation;
    std::vector<std::string> overrides;   ///< path=value
    std::optional<std::uint64_t> frames;  ///< of the display, after which it ends
    std::string size;                     ///< WxH in pixels; empty: that of the scene's camera
    std::string script_file, log_file, record_file;
    bool headless = false;
    bool paused = false;
};
int view_command(const ViewOptions& options);

struct RenderOptions {
    std::string scene;
    SimulationOptions simulation;
    std::vector<std::string> overrides;   ///< path=value
    std::optional<std::uint64_t> frames;  ///< of the scene, instead of its duration
    std::string camera;                   ///< "x,y,z,target x,y,z[,field of view]"; empty: the scene's
    std::string size;                     ///< WxH in pixels
    std::optional<double> frame_rate;     ///< pictures per second; default: the scene's
    std::vector<std::string> overlays;    ///< names of overlays
    std::string compare;                  ///< "method,method"
    std::string out_file;
    bool quiet = false;
};
int render_command(const RenderOptions& options);

/// Parses "640x360". Throws Error(bad_usage) for anything else, and for sides outside 16 to 16384 pixels.
std::pair<std::uint32_t, std::uint32_t> picture_size(const std::string& text);

}  // namespace pliant::tool
