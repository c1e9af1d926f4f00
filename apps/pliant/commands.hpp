// The sub-commands of `pliant`. Each returns the exit code: 0 good, 1 bad input, 2 bad usage, 3 diverged,
// 4 device failure; errors may also be thrown as pliant::Error.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
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
    bool check = false;  ///< hold the run against the scene's own check
    bool quiet = false;
};

/// No output of a run takes the place of another, or of what the run reads; throws Error(bad_usage) that
/// names both.
void check_outputs(const RunOptions& options, const Scene& scene);

int run_command(const RunOptions& options);
int list_command();
int info_command();

struct CheckOptions {
    std::string scene_or_mesh;
    std::vector<std::string> overrides;  ///< path=value, of a scene
    bool repair = false;                 ///< a mesh, by `repair_options`
    RepairOptions repair_options;
    std::string out_file;  ///< for the repaired mesh; empty: it is not kept
};
int check_command(const CheckOptions& options);

}  // namespace pliant::tool
