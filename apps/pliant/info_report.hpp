// A machine's report for users to send in: docs/platforms.md, docs/machine_report.schema.json.
#pragma once

#include <string>

namespace pliant::tool {

/// Runs scenes on every device and instruction set, shows progress, and writes the results. Returns the exit
/// code; it is 0 even if the bits of a device differ, since the report is to show that.
int write_machine_report(const std::string& file);

}  // namespace pliant::tool
