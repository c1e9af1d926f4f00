// The results of an experiment: a document, data/ID.json, the same table as data/ID.csv, and pictures.
#pragma once

#include <filesystem>
#include <string>

#include "experiment.hpp"
#include "measurement.hpp"

namespace pliant::tool::reproduce {

/// The circumstances of a run.
struct Circumstances {
    bool quick = false;
    std::filesystem::path out;     ///< with the folders data, figures and pictures
    std::filesystem::path meshes;  ///< empty: none
    Interrupted interrupted;
    std::function<void(std::size_t done, std::size_t cases, const std::string& note)> progress;
};

/// A hash of everything that determines the measurements: the experiment, its papers' numbers, version,
/// machines, meshes.
std::string key_of(const Experiment& experiment, const Circumstances& here);

/// The document of a completed experiment; empty if it is missing, incomplete, or has another key.
std::optional<Json> finished(const Experiment& experiment, const Circumstances& here);

/// Runs an experiment and writes its files, the document last. May throw Interruption.
Json run_experiment(const Experiment& experiment, const Circumstances& here);

/// The tables of passes and buffers, from passes.def.
Json pass_tables();

/// Writes a text file that appears under its name only when it is complete.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace pliant::tool::reproduce
