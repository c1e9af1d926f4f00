// How the steps of `pliant bench` are timed: those that are compared take turns, so that what else the
// machine does falls on all of them, and every ratio is the median of those of the turns.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/table.hpp"
#include "pliant/simulation.hpp"

namespace pliant::tool {

constexpr double frame = 1.0 / 60;  ///< s, of scenes that are advanced frame by frame

/// One way of doing something. `run` does some of it and returns a number, the same unit every time.
struct Contestant {
    std::function<double()> run;
    std::vector<double> samples = {};
};

/// A turn that does not count (memory is fetched, programs are made), then `repeats` that do.
void take_turns(std::span<Contestant* const> contestants, int repeats);
/// Median over the turns of a's sample over b's.
double ratio_of(const Contestant& a, const Contestant& b);

/// A simulation that is advanced by whole frames of `scene.time.substeps` steps.
class SteppedSimulation {
public:
    SteppedSimulation(const Scene& scene, const SimulationOptions& options);

    /// Advances by a frame; ms for a step of it. The measures of the frame are not counted: they belong to
    /// frames, not to steps, of which a frame may have one or a thousand.
    double milliseconds_per_step();
    double milliseconds_of_measures() const;  ///< of a frame, mean of all so far

    Simulation& simulation() { return simulation_; }
    double stretch() const { return stretch_; }  ///< largest at the end of a frame

private:
    double all_measures() const;  ///< ms

    double duration_, substeps_, stretch_ = 0;
    Simulation simulation_;
};

/// Copies memory where a simulation runs: by its threads, or on its device. What is read and what is written
/// count.
class MemoryCopy {
public:
    virtual ~MemoryCopy() = default;
    virtual double gigabytes_per_second() = 0;
};
/// `bytes` are larger than the caches.
std::unique_ptr<MemoryCopy> make_memory_copy(Simulation& simulation, std::size_t bytes);

}  // namespace pliant::tool
