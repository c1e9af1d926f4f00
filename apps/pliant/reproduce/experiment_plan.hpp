// An experiment as it will run here, and its results: a document, data/ID.json, the same table as
// data/ID.csv, and pictures.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment.hpp"
#include "measurement.hpp"

namespace pliant::tool::reproduce {

/// The circumstances of a run.
struct Circumstances {
    bool quick = false;
    std::filesystem::path out;     ///< with the folders data, figures and pictures
    std::filesystem::path meshes;  ///< empty: none
    Interrupted interrupted;
};

using CaseProgress = std::function<void(std::size_t done, std::size_t cases, const std::string& note)>;

/// What an experiment means here: its cases, the machines, and how a case is measured. All of it is decided
/// by the constructor. Keeps a reference to the experiment.
class ExperimentPlan {
public:
    ExperimentPlan(const Experiment& experiment, Circumstances here);
    ExperimentPlan(const ExperimentPlan&) = delete;  // `measure_` refers to this one
    ExperimentPlan& operator=(const ExperimentPlan&) = delete;

    /// The document of the completed experiment; empty if it is missing, incomplete, or has another key.
    std::optional<Json> finished() const;

    /// Measures all cases and writes the files, the document last. May throw Interruption.
    void run(const CaseProgress& progress) const;

private:
    using Measurements = std::vector<Measurement>;

    std::string key() const;
    std::filesystem::path document_file() const;
    Json measured(const CaseProgress& progress) const;
    void keep_pictures(const Case& each, const Measurement& m, std::size_t number, Json& pictures) const;
    std::string command_of(const CaseScene& made, const Measurements& measurements) const;

    const Experiment& experiment_;
    Circumstances here_;
    std::vector<MachineHere> machines_;
    std::vector<Case> cases_;
    /// One measurement per machine. If pictures cannot be drawn, `no_pictures` gets the reason. Empty for
    /// tables of passes, which are read and not measured.
    std::function<Measurements(const Scene&, std::string& no_pictures)> measure_;
    bool finds_step_ = false;  ///< the command of a case has the step that was found
    std::string key_;          ///< a hash of everything that determines the measurements
};

/// The tables of passes and buffers, from passes.def.
Json pass_tables();

}  // namespace pliant::tool::reproduce
