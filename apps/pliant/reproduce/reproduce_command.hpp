// `pliant reproduce`: the experiments of both papers, and a report of ours beside theirs.
#pragma once

#include <string>
#include <vector>

namespace pliant::tool {

struct ReproduceOptions {
    std::string papers = "all";  ///< cloth, volume or all
    bool quick = false;          ///< small and short: to see that it works, in minutes
    std::string out = "reproduction";
    std::vector<std::string> only;  ///< ids, or parts of them
    std::string meshes;             ///< folder with the scanned meshes; empty: other shapes stand in
    bool list = false;              ///< tell the ids alone
};
/// Exit code: 0 when all that was asked for is done.
int reproduce_command(const ReproduceOptions& options);

}  // namespace pliant::tool
