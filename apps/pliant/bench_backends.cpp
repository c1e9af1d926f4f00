// One sheet on everything that can step it here: every instruction set, the reference, every Vulkan device.
#include <memory>

#include "backend/cpu/kernels.hpp"
#include "bench_bytes.hpp"
#include "bench_harness.hpp"
#include "bench_stepping.hpp"

namespace pliant::tool {
namespace {

struct Entrant {
    Entrant(const Scene& scene, const SimulationOptions& options) : stepped(scene, options)
    {
        step.run = [this] { return stepped.milliseconds_per_step(); };
    }
    SteppedSimulation stepped;
    Contestant step;
};

std::vector<SimulationOptions> everything(const SimulationOptions& given)
{
    std::vector<SimulationOptions> all;
    for (const cpu::Kernels* kernels : cpu::available_kernels()) {
        SimulationOptions options{.backend = Backend::cpu, .threads = 1};
        options.instruction_set = kernels->name;
        all.push_back(options);
    }
    all.push_back({.backend = Backend::cpu, .threads = given.threads});
    for (const DeviceListing& device : list_devices())
        if (device.backend == Backend::vulkan)
            all.push_back({.backend = Backend::vulkan, .device = device.index});
    all.push_back({.backend = Backend::reference});
    return all;
}

}  // namespace

void measure_backends(const std::string& subject, Scene scene, double stiffness, const BenchOptions& options,
                      BenchTable& table)
{
    constexpr std::uint32_t steps = 16;  // the slowest take milliseconds for one
    scene.time.frame_rate *= static_cast<double>(scene.time.substeps) / steps;
    scene.time.substeps = steps;
    std::vector<std::unique_ptr<Entrant>> entrants;
    std::vector<Contestant*> contestants;
    for (const SimulationOptions& each : everything(options.simulation)) {
        entrants.push_back(std::make_unique<Entrant>(scene, each));
        contestants.push_back(&entrants.back()->step);
    }
    take_turns(contestants, 7);
    const ClothModel model(scene.cloth(0), scene);
    const std::uint64_t bits = entrants.front()->stepped.simulation().state_hash();
    for (const auto& entrant : entrants) {
        Simulation& simulation = entrant->stepped.simulation();
        BenchRow row = table.row(simulation, subject + " by " + simulation.device_name(), stiffness,
                                 entrant->stepped.stretch());
        row.in_plot = false;
        row.time = step_time_of(entrant->step.samples);
        row.real_time_factor = 1000 * row.step / row.time->median;
        row.bytes = bytes_per_node_and_step(model, simulation.backend());
        if (simulation.backend() == Backend::reference)
            table.add(row);  // in double: its bits are others
        else
            table.add(row, "same bits as the first", *row.state_hash == bits ? 1 : 0, "1", at_least(1));
    }
}

}  // namespace pliant::tool
