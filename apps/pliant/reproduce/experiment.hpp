// Experiments as data: experiments.json and papers.json, which are part of the program.
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

/// Where something is run.
enum class Machine {
    serial,  ///< the papers' algorithm, one thread
    cpu,     ///< Pliant's backend of that name
    vulkan,
    best,  ///< Pliant's own choice: vulkan on a real GPU, else cpu
};
const char* name_of(Machine machine);

/// One thing that an axis can be: overrides of the scene.
struct AxisValue {
    std::string label;                   ///< what a table says
    std::string key;                     ///< what papers.json says
    std::vector<std::string> set;        ///< PATH=VALUE
    std::string mesh;                    ///< file among the meshes that are given; empty: none is needed
    std::optional<double> mesh_height;   ///< m, to which the mesh is scaled
    std::shared_ptr<AxisValue> instead;  ///< when the mesh is not there
    bool quick = true;                   ///< part of a quick run
    std::map<std::string, std::vector<std::string>> only;  ///< by axis: the keys that it goes together with
};
struct Axis {
    std::string name;
    bool mean = false;  ///< the table ends with means over this axis
    std::vector<AxisValue> values;
};

/// One row of a table: a scene and how it is changed.
struct Case {
    std::vector<std::string> labels, keys;  ///< one for each axis
    std::vector<std::string> set;
    std::string mesh;
    std::optional<double> mesh_height;
};

struct Ratio {
    std::string title;
    Machine of, over;
    std::string quantity;
};

/// A number that is written once for a quick run and once for a full one.
struct TwoNumbers {
    double full = 0, quick = 0;
    double of(bool is_quick) const { return is_quick ? quick : full; }
};

/// How the longest step is looked for.
struct StabilityRule {
    TwoNumbers duration;         ///< s, that a cloth must stand
    TwoNumbers within;           ///< 0.01: the step is found to 1 %
    double stretch_at_most = 0;  ///< of any spring at any time, (l - l0) / l0
    double timed_at_most = 0;    ///< s: what a step costs is measured with the longest one up to this
};

struct Experiment {  // NOLINT(bugprone-exception-escape): to move JSON does not throw
    Json data;       ///< as it is written
    std::string id, paper, item, title, kind;  ///< kind: speed, behaviour, stability, passes
    std::string scene, setting, differs;
    std::vector<std::string> set;
    std::vector<Axis> axes;
    std::vector<Machine> machines;
    TwoNumbers frames;                 ///< of a case, at most
    TwoNumbers seconds;                ///< of a case on a machine, about: fewer frames where they take longer
    TwoNumbers software_nodes;         ///< largest case that a software Vulkan device runs
    std::uint64_t batch = 0;           ///< frames in one call; 0: a fifth of them
    std::optional<double> rest_above;  ///< m: the body's lowest point is put so high
    StabilityRule stability;           ///< of that kind
    std::vector<double> picture_times[2];  ///< s; full, quick
    std::vector<std::string> of_case, quantities;
    std::vector<Ratio> ratios;

    /// All combinations of the axes. `meshes` may be empty: then other shapes stand in.
    std::vector<Case> cases(bool quick, const std::filesystem::path& meshes) const;
};

/// In the order of the report.
const std::vector<Experiment>& experiments();
/// papers.json.
const Json& papers();
/// plots.py.
const char* plots_script();

}  // namespace pliant::tool::reproduce
