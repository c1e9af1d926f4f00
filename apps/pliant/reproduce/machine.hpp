// The machines of an experiment.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "experiment.hpp"
#include "pliant/simulation.hpp"

namespace pliant::tool::reproduce {

struct MachineHere {
    Machine machine = Machine::best;
    std::string title;      ///< of columns
    std::string device;     ///< with its kind
    bool software = false;  ///< a Vulkan device without a GPU: correct, but not for benchmarks
    SimulationOptions options;
};

/// The present realisation of a machine; empty if it is not available.
std::optional<MachineHere> machine_here(Machine machine);

/// Steps a scene on a machine, frame by frame.
class Stepper {
public:
    virtual ~Stepper() = default;
    /// Advances this many frames in one call; returns the seconds taken.
    virtual double advance(std::uint64_t frames) = 0;
    /// Pliant's own; null for the serial baseline.
    virtual Simulation* simulation() { return nullptr; }
};
/// Throws Error if the scene cannot run there.
std::unique_ptr<Stepper> make_stepper(const Scene& scene, const MachineHere& machine);

}  // namespace pliant::tool::reproduce
