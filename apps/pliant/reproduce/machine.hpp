// The machines that an experiment runs on.
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
    bool software = false;  ///< a Vulkan device without a GPU: correct, and no benchmark
    SimulationOptions options;
};

/// How a machine is to be had here; nothing when there is none.
std::optional<MachineHere> machine_here(Machine machine);

/// A scene on a machine, frame by frame.
class Stepper {
public:
    virtual ~Stepper() = default;
    /// Seconds that this many frames took, in one call.
    virtual double advance(std::uint64_t frames) = 0;
    /// Pliant's own; null for the serial baseline.
    virtual Simulation* simulation() { return nullptr; }
};
/// Throws Error when the scene cannot be run there.
std::unique_ptr<Stepper> make_stepper(const Scene& scene, const MachineHere& machine);

}  // namespace pliant::tool::reproduce
