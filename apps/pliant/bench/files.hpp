// The rows of `pliant bench` as files.
#pragma once

#include <span>
#include <string>

#include "bench/table.hpp"
#include "files/atomic_file.hpp"

namespace pliant::tool {

struct BenchMachine {
    std::string name;    ///< processor or device, and cores
    bool quick = false;  ///< the figures are not meaningful
};

/// Keys that do not apply to a row are absent; docs/performance.md explains them.
void write_json(AtomicFile& file, const BenchMachine& machine, std::span<const BenchRow> rows);
/// One line per measured number, with its whole row; one line for a row without any.
void write_csv(AtomicFile& file, const BenchMachine& machine, std::span<const BenchRow> rows);
/// ns per node and step over nodes, both logarithmic: a line for each case, backend and number of threads
/// (SVG).
void write_plot(AtomicFile& file, const BenchMachine& machine, std::span<const BenchRow> rows);

}  // namespace pliant::tool
