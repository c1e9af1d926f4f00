// What an experiment leaves: a document, data/ID.json, beside the same table as data/ID.csv and its pictures.
#pragma once

#include <filesystem>
#include <string>

#include "experiment.hpp"
#include "measurement.hpp"

namespace pliant::tool::reproduce {

/// Under which circumstances experiments are run.
struct Circumstances {
    bool quick = false;
    std::filesystem::path out;     ///< with the folders data, figures and pictures
    std::filesystem::path meshes;  ///< empty: none
    Interrupted interrupted;
    std::function<void(std::size_t done, std::size_t cases, const std::string& note)> progress;
};

/// A hash of all that decides what is measured: the experiment, its papers' numbers, version, machines,
/// meshes.
std::string key_of(const Experiment& experiment, const Circumstances& here);

/// The document of a finished experiment; nothing when it is not there, not complete, or of another key.
std::optional<Json> finished(const Experiment& experiment, const Circumstances& here);

/// Runs an experiment and writes its files, the document last. Throws Interruption.
Json run_experiment(const Experiment& experiment, const Circumstances& here);

/// The tables of passes and buffers, from passes.def.
Json pass_tables();

/// Writes a text so that it appears under its name only when it is complete.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace pliant::tool::reproduce
