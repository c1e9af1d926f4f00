// Experiments as data: experiments.json and papers.json, which are embedded in the program.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace pliant::tool::reproduce {

using Json = nlohmann::ordered_json;

/// Where an experiment runs.
enum class Machine {
    serial,  ///< the papers' algorithm, one thread
    cpu,     ///< Pliant's backend of that name
    vulkan,
    best,  ///< Pliant's own choice: vulkan on a real GPU, else cpu
};
const char* name_of(Machine machine);

/// One value of an axis: overrides of the scene.
struct AxisValue {
    std::string label;                   ///< text in tables
    std::string key;                     ///< key in papers.json
    std::vector<std::string> set;        ///< PATH=VALUE
    std::string mesh;                    ///< file in the folder of meshes; empty: none is needed
    std::optional<double> mesh_height;   ///< m, to which the mesh is scaled
    std::shared_ptr<AxisValue> instead;  ///< replacement if the mesh is missing
    bool quick = true;                   ///< included in a quick run
    std::map<std::string, std::vector<std::string>> only;  ///< by axis: the keys with which it is combined
};
struct Axis {
    std::string name;
    bool mean = false;  ///< the table ends with means over this axis
    std::vector<AxisValue> values;
};

/// One row of a table: a scene and its overrides.
struct Case {
    std::vector<std::string> labels, keys;  ///< one per axis
    std::vector<std::string> set;
    std::string mesh;
    std::optional<double> mesh_height;
};

struct Ratio {
    std::string title;
    Machine of, over;
    std::string quantity;
};

/// A number for a quick run and one for a full run.
struct TwoNumbers {
    double full = 0, quick = 0;
    double of(bool is_quick) const { return is_quick ? quick : full; }
};

/// The search for the longest stable step.
struct StabilityRule {
    TwoNumbers duration;         ///< s, for which a cloth must stay intact
    TwoNumbers within;           ///< 0.01: the step is found within 1 %
    double stretch_at_most = 0;  ///< maximum strain of any spring at any time, (l - l0) / l0
    double timed_at_most = 0;    ///< s: the cost of a step is measured with the longest stable one up to this
};

enum class ExperimentKind {
    speed,      ///< frames per second
    behaviour,  ///< measures of the motion, with pictures
    stability,  ///< the longest stable step
    passes,     ///< tables of passes: nothing is measured
};

struct Experiment {  // NOLINT(bugprone-exception-escape): moving JSON does not throw
    Json data;       ///< as in the file
    ExperimentKind kind = ExperimentKind::passes;
    std::string id, paper, item, title;
    std::string scene, setting, differs;
    std::vector<std::string> set;
    std::vector<Axis> axes;
    std::vector<Machine> machines;
    TwoNumbers frames;                 ///< maximum, of a case
    TwoNumbers seconds;                ///< of a case on a machine, approximately: fewer frames if they take
                                       ///< longer
    TwoNumbers software_nodes;         ///< largest case that runs on a software Vulkan device
    std::uint64_t batch = 0;           ///< frames per call; 0: a fifth of them
    std::optional<double> rest_above;  ///< m: the height at which the body's lowest point is placed
    StabilityRule stability;           ///< for the kind stability
    std::vector<double> picture_times[2];  ///< s; full, quick
    std::vector<std::string> of_case, quantities;
    std::vector<Ratio> ratios;

    /// All combinations of the axes. `meshes` may be empty: then other shapes are used.
    std::vector<Case> cases(bool quick, const std::filesystem::path& meshes) const;
};

/// In the order of the report.
const std::vector<Experiment>& experiments();
/// papers.json.
const Json& papers();
/// plots.py.
const char* plots_script();

}  // namespace pliant::tool::reproduce
