// The report of all completed experiments: report.html, report.md, results.csv.
#pragma once

#include <filesystem>
#include <vector>

#include "experiment.hpp"

namespace pliant::tool::reproduce {

/// `documents`: from ExperimentPlan. Includes figures/ID.svg where it exists. `notes` are at the top.
void write_report(const std::filesystem::path& out, const std::vector<Json>& documents,
                  const std::vector<std::string>& notes);

}  // namespace pliant::tool::reproduce
