// The report of a machine that a person can send in: docs/platforms.md, docs/machine_report.schema.json.
#pragma once

#include <string>

namespace pliant::tool {

/// Runs scenes on every device and instruction set, tells how far it is, and writes what came of it. Returns
/// the exit code: of a device whose bits differ, too, it is 0, for that is what a report is for.
int write_machine_report(const std::string& file);

}  // namespace pliant::tool
