#include "machine.hpp"

#include <chrono>
#include <variant>

#include "serial_scene.hpp"

namespace pliant::tool::reproduce {
namespace {

class PliantStepper : public Stepper {
public:
    PliantStepper(const Scene& scene, const SimulationOptions& options)
        : simulation_(scene, options), frame_(1 / scene.time.frame_rate)
    {
    }
    double advance(std::uint64_t frames) override
    {
        const double before = simulation_.report().wall_seconds;
        simulation_.advance(static_cast<double>(frames) * frame_);
        return simulation_.report().wall_seconds - before;
    }
    Simulation* simulation() override { return &simulation_; }

private:
    Simulation simulation_;
    double frame_;
};

class SerialStepper : public Stepper {
public:
    explicit SerialStepper(const Scene& scene)
        : steps_(scene.time.substeps),
          dt_(static_cast<float>(1 / (scene.time.frame_rate * scene.time.substeps)))
    {
        if (scene.method == Method::volume)
            thing_ = serial::body_of(scene);
        else
            thing_ = serial::cloth_of(scene);
    }
    double advance(std::uint64_t frames) override
    {
        const auto start = std::chrono::steady_clock::now();
        std::visit(
            [&](auto& thing) {
                for (std::uint64_t k = 0; k < frames * steps_; ++k) serial::step(thing, dt_);
            },
            thing_);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

private:
    std::variant<serial::Cloth, serial::Body> thing_;
    std::uint64_t steps_;
    float dt_;
};

}  // namespace

std::optional<MachineHere> machine_here(Machine machine)
{
    std::optional<DeviceListing> gpu, software;
    std::string instruction_set;
    for (const DeviceListing& device : list_devices()) {
        if (device.backend == Backend::cpu) instruction_set = device.kind;
        if (device.backend != Backend::vulkan) continue;
        auto& found = device.kind == "software" ? software : gpu;
        if (!found) found = device;
    }
    if (machine == Machine::best) {
        auto best = machine_here(gpu ? Machine::vulkan : Machine::cpu);
        best->machine = Machine::best;
        return best;
    }
    MachineHere here;
    here.machine = machine;
    switch (machine) {
        case Machine::serial:
            here.title = "serial";
            here.device = "one thread, list of springs, C++";
            break;
        case Machine::cpu:
            here.title = "cpu";
            here.options.backend = Backend::cpu;
            here.device = "cpu backend, " + instruction_set;
            break;
        case Machine::vulkan: {
            const auto& device = gpu ? gpu : software;
            if (!device) return std::nullopt;
            here.title = "vulkan";
            here.options.backend = Backend::vulkan;
            here.options.device = device->index;
            here.software = !gpu;
            here.device = device->name + (gpu ? "" : " (software: no benchmark)");
            break;
        }
        case Machine::best: break;
    }
    return here;
}

std::unique_ptr<Stepper> make_stepper(const Scene& scene, const MachineHere& machine)
{
    if (machine.machine == Machine::serial) return std::make_unique<SerialStepper>(scene);
    return std::make_unique<PliantStepper>(scene, machine.options);
}

}  // namespace pliant::tool::reproduce
