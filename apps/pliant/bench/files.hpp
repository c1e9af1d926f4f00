// The rows of `pliant bench` as files.
#pragma once

#include <span>
#include <string>

#include "bench/table.hpp"
#include "files/atomic_file.hpp"

namespace pliant::tool {

struct BenchMachine {
    std::string name;    ///< processor or device, and cores
    bool quick = false;  ///< figures say nothing
};

/// Absent keys are those that make no sense for a row; docs/performance.md has their meaning.
void write_json(AtomicFile& file, const BenchMachine& machine, std::span<const BenchRow> rows);
/// One line for each number that was measured, with all of its row; one for a row without.
void write_csv(AtomicFile& file, const BenchMachine& machine, std::span<const BenchRow> rows);
/// ns per node and step over nodes, both logarithmic: a line for each case, backend and number of threads
/// (SVG).
void write_plot(AtomicFile& file, const BenchMachine& machine, std::span<const BenchRow> rows);

}  // namespace pliant::tool
