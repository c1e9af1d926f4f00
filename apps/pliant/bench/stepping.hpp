// A case of explicit steps: Pliant by one thread and by all, the serial baseline, Bullet, and copying, in
// turns.
#pragma once

#include <cstdint>
#include <string>

#include "bench/bench_command.hpp"

namespace pliant::tool {

/// What is stepped, and what is asked of it.
struct SteppingCase {
    std::string subject;      ///< the same at all sizes
    Scene scene;              ///< its substeps are the steps of a sample
    double stiffness = 0;     ///< N/m, the largest
    bool bullet = false;      ///< compare with btSoftBody, too, where it was built in
    bool one_thread = false;  ///< measure one thread of the backend cpu beside all that were asked for
    // Bars on the backend cpu; 0 asks nothing.
    double faster_than_serial = 0;  ///< two threads or more, against `serial`
    double faster_than_serial_one_thread = 0;
    double scaling = 0;  ///< all threads against one
    // Bars on a GPU.
    double copy_fraction = 0, steps_per_second = 0;
};

/// Adds a row for each way. Baselines run with denormal numbers flushed, as Pliant does.
void measure_stepping(const SteppingCase& what, const BenchOptions& options, BenchTable& table);

/// The scene on every backend, instruction set and device of this machine, in turns.
void measure_backends(const std::string& subject, Scene scene, double stiffness, const BenchOptions& options,
                      BenchTable& table);

/// A scene of the cloth alone. Its steps are stable, at most `longest` s, and have three significant digits;
/// a frame has so many of them that it lasts long enough to be timed.
Scene stepped_scene(Cloth cloth, Method method, bool quick, double longest = 1);

std::string with_commas(std::uint64_t number);  ///< 7,817,616

}  // namespace pliant::tool
