#include "bench/stepping.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "backend/cpu/jobs.hpp"
#include "backend/vulkan/device_state.hpp"
#include "bench/bytes.hpp"
#include "bench/harness.hpp"
#include "bullet_cloth.hpp"
#include "serial_scene.hpp"

namespace pliant::tool {
namespace {

constexpr int repeats = 7;

/// A simulation and its memory copy.
struct Pliant {
    Pliant(const Scene& scene, const SimulationOptions& options, std::size_t copied)
        : stepped(scene, options), copy(make_memory_copy(stepped.simulation(), copied))
    {
        step.run = [this] { return stepped.milliseconds_per_step(); };
        bandwidth.run = [this] { return copy->gigabytes_per_second(); };
    }
    SteppedSimulation stepped;
    std::unique_ptr<MemoryCopy> copy;
    Contestant step, bandwidth;
};

/// When called, makes `count` steps of a baseline and returns ms per step.
template <class Step>
std::function<double()> timed(std::uint32_t count, Step step)
{
    return [=] {
        const cpu::DenormalsFlushed flushed;
        const auto start = std::chrono::steady_clock::now();
        for (std::uint32_t k = 0; k < count; ++k) step();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() /
               count;
    };
}

/// Baselines make fewer steps per turn: they are slower, and that suffices for timing.
std::function<double()> serial_step(const Scene& scene, float dt)
{
    const std::uint32_t count = std::max(1u, scene.time.substeps / 8);
    if (scene.method == Method::volume)
        return timed(count, [body = std::make_shared<serial::Body>(serial::body_of(scene)), dt] {
            serial::step(*body, dt);
        });
    return timed(count, [cloth = std::make_shared<serial::Cloth>(serial::cloth_of(scene)), dt] {
        serial::step(*cloth, dt);
    });
}

/// Empty without Bullet.
std::function<double()> bullet_step(const Scene& scene, float dt)
{
    std::shared_ptr<bullet::SoftBody> body = bullet::soft_body_of(serial::cloth_of(scene));
    if (!body) return {};
    return timed(std::max(1u, scene.time.substeps / 32), [body, dt] { body->step(dt); });
}

/// The row of a baseline that steps the same scene as a row of Pliant.
BenchRow baseline_row(const BenchRow& like, const char* backend, const Contestant& steps)
{
    BenchRow row;
    row.suite = like.suite;
    row.subject = like.subject;
    row.method = like.method;
    row.backend = backend;
    row.device = std::string("CPU, ") + backend;
    row.threads = 1;
    row.nodes = like.nodes;
    row.springs = like.springs;
    row.triangles = like.triangles;
    row.stiffness = like.stiffness;
    row.step = like.step;
    row.time = step_time_of(steps.samples);
    row.real_time_factor = 1000 * row.step / row.time->median;
    return row;
}

bool on_gpu(Simulation& simulation)
{
    DeviceState* state = simulation.device_state();
    return state && state->device()->info().hardware;
}

}  // namespace

std::string with_commas(std::uint64_t number)
{
    std::string text = std::to_string(number);
    for (std::size_t k = text.size(); k > 3;) text.insert(k -= 3, ",");
    return text;
}

Scene stepped_scene(Cloth cloth, Method method, bool quick, double longest)
{
    Scene scene;
    scene.method = method;
    scene.add(std::move(cloth));
    const ClothModel model(scene.cloth(0), scene);
    const double most = std::min(model.stable_step(), longest);
    const double digit = std::pow(10, std::floor(std::log10(most)) - 2);
    const double step = std::floor(most / digit * (1 + 1e-9)) * digit;

    // Steps that together take some tens of ms: a power of two, 8 for the largest cloths.
    const std::uint64_t least_count = quick ? 2 : 8, most_count = quick ? 8 : 512;
    const std::uint64_t node_steps = quick ? 1'000 : 4'000'000;
    std::uint64_t count = least_count;
    while (count < most_count && 2 * count * model.node_count() <= node_steps) count *= 2;
    scene.time.substeps = static_cast<std::uint32_t>(count);
    scene.time.frame_rate = 1 / (step * scene.time.substeps);
    return scene;
}

void measure_stepping(const SteppingCase& what, const BenchOptions& options, BenchTable& table)
{
    const std::size_t copied = options.quick ? std::size_t{1} << 20 : std::size_t{128} << 20;
    Pliant all(what.scene, options.simulation, copied);
    const Backend backend = all.stepped.simulation().backend();
    std::optional<Pliant> one;
    if (what.one_thread && backend == Backend::cpu && all.stepped.simulation().thread_count() > 1) {
        SimulationOptions single = options.simulation;
        single.threads = 1;
        one.emplace(what.scene, single, copied);
    }

    const double bytes = bytes_per_node_and_step(ClothModel(what.scene.cloth(0), what.scene), backend);

    const auto dt = static_cast<float>(1 / (what.scene.time.frame_rate * what.scene.time.substeps));
    Contestant serial{serial_step(what.scene, dt)},
        bullet{what.bullet ? bullet_step(what.scene, dt) : nullptr};
    std::vector<Contestant*> contestants = {&serial};
    if (bullet.run) contestants.push_back(&bullet);
    if (one) contestants.insert(contestants.end(), {&one->step, &one->bandwidth});
    contestants.insert(contestants.end(), {&all.step, &all.bandwidth});
    take_turns(contestants, repeats);

    const auto add = [&](Pliant& pliant) {
        Simulation& simulation = pliant.stepped.simulation();
        BenchRow row = table.row(simulation, what.subject, what.stiffness, pliant.stepped.stretch());
        row.time = step_time_of(pliant.step.samples);
        row.real_time_factor = 1000 * row.step / row.time->median;
        row.bytes = bytes;
        std::vector<double> fractions;
        for (std::size_t k = 0; k < pliant.step.samples.size(); ++k)
            fractions.push_back(row.bytes * static_cast<double>(row.nodes) / (1e6 * pliant.step.samples[k]) /
                                pliant.bandwidth.samples[k]);
        row.copy_fraction = median_of(fractions);
        row.ratio_to_serial = ratio_of(serial, pliant.step);
        if (bullet.run) row.ratio_to_soft_body = ratio_of(bullet, pliant.step);
        table.add(row);
        table.add(row, "copying", median_of(pliant.bandwidth.samples), "GB/s");
        table.add(row, "measures of a frame", pliant.stepped.milliseconds_of_measures(), "ms");
        const bool gpu = on_gpu(simulation);
        const double faster_than_serial =
            row.threads == 1 ? what.faster_than_serial_one_thread : what.faster_than_serial;
        if (backend == Backend::cpu && faster_than_serial > 0)
            table.add(row, "times as fast as serial", *row.ratio_to_serial, "1",
                      at_least(faster_than_serial));
        if (gpu && what.copy_fraction > 0)
            table.add(row, "of the bandwidth of copying", *row.copy_fraction, "1",
                      at_least(what.copy_fraction));
        if (gpu && what.steps_per_second > 0)
            table.add(row, "steps", 1000 / row.time->median, "1/s", at_least(what.steps_per_second));
        if (!simulation.report().finite) table.add(row, "finite", 0, "1", at_least(1));
        return row;
    };
    if (one) add(*one);
    const BenchRow last = add(all);
    if (one && what.scaling > 0)
        table.add(last, "times as fast as one thread", ratio_of(one->step, all.step), "1",
                  at_least(what.scaling));
    table.add(baseline_row(last, "serial", serial));
    if (bullet.run) table.add(baseline_row(last, "btSoftBody", bullet));
}

}  // namespace pliant::tool
