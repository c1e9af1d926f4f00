// The report of all experiments that are done: report.html, report.md, results.csv.
#pragma once

#include <filesystem>
#include <vector>

#include "experiment.hpp"

namespace pliant::tool::reproduce {

/// `documents` as run_experiment made them. Figures are taken from figures/ID.svg where there is one. `notes`
/// are said on top.
void write_report(const std::filesystem::path& out, const std::vector<Json>& documents,
                  const std::vector<std::string>& notes);

}  // namespace pliant::tool::reproduce
