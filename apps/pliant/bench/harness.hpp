// Timing of `pliant bench`: compared steps alternate, so that other load on the machine affects all of them,
// and every ratio is the median over the turns.
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

/// One of the compared implementations. `run` does some work and returns a number, in the same unit every
/// time.
struct Contestant {
    std::function<double()> run;
    std::vector<double> samples = {};
};

/// One warm-up turn (memory, programs), then `repeats` measured turns.
void take_turns(std::span<Contestant* const> contestants, int repeats);
/// The median over the turns of a's sample divided by b's.
double ratio_of(const Contestant& a, const Contestant& b);

/// A simulation that is advanced by whole frames of `scene.time.substeps` steps.
class SteppedSimulation {
public:
    SteppedSimulation(const Scene& scene, const SimulationOptions& options);

    /// Advances by a frame; returns ms per step. Excludes the measures of the frame: their cost is per frame,
    /// and a frame may have one step or a thousand.
    double milliseconds_per_step();
    double milliseconds_of_measures() const;  ///< per frame, mean so far

    Simulation& simulation() { return simulation_; }
    double stretch() const { return stretch_; }  ///< maximum at the ends of frames

private:
    double all_measures() const;  ///< ms

    double duration_, substeps_, stretch_ = 0;
    Simulation simulation_;
};

/// Copies memory where a simulation runs: with its threads, or on its device. Bytes read and written count.
class MemoryCopy {
public:
    virtual ~MemoryCopy() = default;
    virtual double gigabytes_per_second() = 0;
};
/// `bytes`: more than the caches hold.
std::unique_ptr<MemoryCopy> make_memory_copy(Simulation& simulation, std::size_t bytes);

}  // namespace pliant::tool
