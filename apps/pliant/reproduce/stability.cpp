// Finds the longest stable step of each integrator in a scene by running it, and the cost of a step.
#include <algorithm>
#include <cmath>

#include "measurement.hpp"

namespace pliant::tool::reproduce {
namespace {

// The range of the search for the longest step, s.
constexpr double shortest = 1e-5, longest = 0.1;
constexpr double look = 1.0 / 60;  // s between two checks of the cloth, approximately: a frame

void set_step(Scene& scene, double step)
{
    const double steps = std::max(1.0, std::floor(look / step));
    scene.time.frame_rate = 1 / (steps * step);
    scene.time.substeps = static_cast<std::uint32_t>(steps);
}

/// Whether the cloth is intact after `duration` s in steps of this length: finite, and no spring was ever
/// stretched by more than `most`.
bool stands(Scene scene, double step, double duration, double most, const MachineHere& machine,
            const Interrupted& interrupted)
{
    set_step(scene, step);
    Simulation simulation(scene, machine.options);
    while (simulation.time() < duration) {
        if (interrupted()) throw Interruption{};
        simulation.advance(1 / scene.time.frame_rate);
        const Report& report = simulation.report();
        if (report.device_lost) throw Error(ErrorKind::device_failure, report.failure);
        if (!report.finite || !(report.measures.max_stretch <= most)) return false;
    }
    return true;
}

}  // namespace

std::vector<Measurement> measure_stability(const Experiment& experiment, const Scene& scene, bool quick,
                                           const std::vector<MachineHere>& machines,
                                           const Interrupted& interrupted)
{
    const StabilityRule& rule = experiment.stability;
    std::vector<Measurement> measurements;
    for (const MachineHere& machine : machines) {
        const auto holds = [&](double step) {
            return stands(scene, step, rule.duration.of(quick), rule.stretch_at_most, machine, interrupted);
        };
        // Downwards from the longest step, since diverging runs end soon; then bisection of the ratio.
        double good = longest, bad = longest;
        bool any = holds(good);
        const bool beyond = any;
        while (!any && good > shortest) {
            bad = good;
            good = std::max(good / 4, shortest);
            any = holds(good);
        }
        while (any && bad / good > 1 + rule.within.of(quick)) {
            const double middle = std::sqrt(good * bad);
            (holds(middle) ? good : bad) = middle;
        }

        Scene timed = scene;
        set_step(timed, std::min(good, rule.timed_at_most));
        Measurement m = measure_speed(experiment, timed, quick, {machine}, interrupted).front();
        m.step_longest = any ? good : 0;
        m.step_longest_is_bound = beyond;
        measurements.push_back(std::move(m));
    }
    return measurements;
}

}  // namespace pliant::tool::reproduce
