// One sheet on everything here that can step it: every instruction set, the reference, every Vulkan device;
// also with fast math, and with several steps per dispatch.
#include <memory>

#include "backend/cpu/kernels.hpp"
#include "backend/vulkan/sheet_tile.hpp"
#include "bench/bytes.hpp"
#include "bench/harness.hpp"
#include "bench/stepping.hpp"

namespace pliant::tool {
namespace {

struct Entrant {
    Entrant(const Scene& scene, const SimulationOptions& given) : stepped(scene, given), options(given)
    {
        step.run = [this] { return stepped.milliseconds_per_step(); };
    }
    SteppedSimulation stepped;
    SimulationOptions options;
    Contestant step;
};

std::vector<SimulationOptions> everything(const SimulationOptions& given)
{
    std::vector<SimulationOptions> all;
    for (const cpu::Kernels* kernels : cpu::available_kernels()) {
        SimulationOptions options{.backend = Backend::cpu, .threads = 1};
        options.instruction_set = kernels->name;
        all.push_back(options);
        options.fast_math = kernels != cpu::available_kernels().front();
        if (options.fast_math) all.push_back(options);
    }
    all.push_back({.backend = Backend::cpu, .threads = given.threads});
    for (const DeviceListing& device : list_devices()) {
        if (device.backend != Backend::vulkan) continue;
        SimulationOptions options{.backend = Backend::vulkan, .device = device.index};
        for (options.gpu_substeps = 1; options.gpu_substeps <= vulkan::most_sheet_steps;
             ++options.gpu_substeps)
            all.push_back(options);
        options.gpu_substeps = 1;
        options.fast_math = true;
        all.push_back(options);
    }
    all.push_back({.backend = Backend::reference});
    return all;
}

}  // namespace

void measure_backends(const std::string& subject, Scene scene, double stiffness, const BenchOptions& options,
                      BenchTable& table)
{
    constexpr std::uint32_t steps = 16;  // the slowest take milliseconds per step
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
        const SimulationOptions& with = entrant->options;
        std::string subject_of = subject + " by " + simulation.device_name();
        if (with.gpu_substeps > 1)
            subject_of += ", " + std::to_string(with.gpu_substeps) + " steps in a dispatch";
        BenchRow row = table.row(simulation, subject_of, stiffness, entrant->stepped.stretch());
        row.in_plot = false;
        row.time = step_time_of(entrant->step.samples);
        row.real_time_factor = 1000 * row.step / row.time->median;
        row.bytes = bytes_per_node_and_step(model, simulation.backend());
        if (simulation.backend() == Backend::reference || with.fast_math)
            table.add(row);  // in double, or with fast math: the bits differ
        else
            table.add(row, "same bits as the first", *row.state_hash == bits ? 1 : 0, "1", at_least(1));
    }
}

}  // namespace pliant::tool
