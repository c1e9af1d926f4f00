// `pliant reproduce`: the experiments of both papers, and a report with our numbers beside theirs.
#pragma once

#include <string>
#include <vector>

namespace pliant::tool {

struct ReproduceOptions {
    std::string papers = "all";  ///< cloth, volume or all
    bool quick = false;          ///< small and short: a test run in minutes
    std::string out = "reproduction";
    std::vector<std::string> only;  ///< ids, or parts of them
    std::string meshes;             ///< folder with the scanned meshes; empty: other shapes are used
    bool list = false;              ///< only print the ids
};
/// Exit code: 0 if all chosen experiments are complete.
int reproduce_command(const ReproduceOptions& options);

}  // namespace pliant::tool
