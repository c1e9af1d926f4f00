// A case of explicit steps: Pliant with one thread and with all, the serial baseline, Bullet, and copying,
// alternating.
#pragma once

#include <cstdint>
#include <string>

#include "bench/bench_command.hpp"

namespace pliant::tool {

/// A scene and its bars.
struct SteppingCase {
    std::string subject;      ///< the same at all sizes
    Scene scene;              ///< its substeps are the steps of a sample
    double stiffness = 0;     ///< N/m, the largest
    bool bullet = false;      ///< also compare with btSoftBody, if available
    bool one_thread = false;  ///< also measure the backend cpu with one thread
    // Bars for the backend cpu; 0: none.
    double faster_than_serial = 0;  ///< two threads or more, relative to `serial`
    double faster_than_serial_one_thread = 0;
    double scaling = 0;  ///< all threads relative to one
    // Bars for a GPU.
    double copy_fraction = 0, steps_per_second = 0;
};

/// Adds a row for each implementation. Baselines run with denormals flushed, as Pliant does.
void measure_stepping(const SteppingCase& what, const BenchOptions& options, BenchTable& table);

/// The scene on every backend, instruction set and device of this machine, alternating.
void measure_backends(const std::string& subject, Scene scene, double stiffness, const BenchOptions& options,
                      BenchTable& table);

/// A scene with this cloth alone. Its steps are stable, at most `longest` s, with three significant digits; a
/// frame has enough of them to be timed.
Scene stepped_scene(Cloth cloth, Method method, bool quick, double longest = 1);

std::string with_commas(std::uint64_t number);  ///< 7,817,616

}  // namespace pliant::tool
