// The quantities available in experiments.json.
#include <cmath>
#include <cstdio>

#include "measurement.hpp"
#include "pliant/error.hpp"

namespace pliant::tool::reproduce {
namespace {

std::string percent(double fraction) { return number_text(100 * fraction); }
std::string if_measured(const Measurement& m, const std::string& text) { return m.measured ? text : ""; }

constexpr Quantity quantities[] = {
    {"nodes", "nodes", "", [](const Measurement& m) { return number_text(static_cast<double>(m.nodes)); }},
    {"springs", "springs", "",
     [](const Measurement& m) { return number_text(static_cast<double>(m.springs)); }},
    {"frames", "frames", "", [](const Measurement& m) { return number_text(static_cast<double>(m.frames)); }},
    {"steps_per_frame", "steps per frame", "",
     [](const Measurement& m) { return number_text(m.steps_per_frame); }},
    {"step_ms", "step", "ms", [](const Measurement& m) { return number_text(1000 * m.step); }},
    {"frames_per_second", "frames/s", "",
     [](const Measurement& m) { return number_text(m.frames_per_second); }},
    {"stretch_peak_percent", "largest stretch", "%",
     [](const Measurement& m) { return if_measured(m, m.finite ? percent(m.stretch_peak) : "diverged"); }},
    {"stretch_last_percent", "largest stretch in the last second", "%",
     [](const Measurement& m) { return if_measured(m, m.finite ? percent(m.stretch_last) : "diverged"); }},
    {"diverged_in_frame", "diverged in frame", "",
     [](const Measurement& m) {
         return m.finite ? std::string("-") : number_text(static_cast<double>(m.bad_frame));
     }},
    {"step_longest_ms", "longest step", "ms",
     [](const Measurement& m) {
         const std::string text = number_text(1000 * m.step_longest);
         return m.step_longest == 0 ? "none" : m.step_longest_is_bound ? "over " + text : text;
     }},
    {"timed_step_ms", "step that is timed", "ms",
     [](const Measurement& m) { return number_text(1000 * m.step); }},
    {"step_cost_us", "time for a step", "us",
     [](const Measurement& m) {
         return if_measured(m, number_text(1e6 / m.frames_per_second / m.steps_per_frame));
     }},
    {"second_cost_ms", "time for a simulated second", "ms",
     [](const Measurement& m) {
         return if_measured(m, number_text(1e3 / m.frames_per_second / m.steps_per_frame / m.step));
     }},
    {"residual_max", "largest residual", "",
     [](const Measurement& m) { return if_measured(m, number_text(m.solver.residual_max)); }},
    {"active_mean", "active constraints, mean", "",
     [](const Measurement& m) { return if_measured(m, number_text(m.solver.active_mean)); }},
    {"volume_loss_max_percent", "largest loss", "%",
     [](const Measurement& m) { return if_measured(m, percent(m.volume.loss_max)); }},
    {"volume_gain_max_percent", "largest gain", "%",
     [](const Measurement& m) { return if_measured(m, percent(m.volume.gain_max)); }},
    {"volume_loss_mean_percent", "mean loss", "%",
     [](const Measurement& m) { return if_measured(m, percent(m.volume.loss_mean)); }},
};

}  // namespace

std::string number_text(double value)
{
    if (!std::isfinite(value)) return value > 0 ? "inf" : "nan";
    char text[48];
    const bool whole = value == std::floor(value) && std::abs(value) < 1e9;
    const bool large = std::abs(value) >= 1000 && std::abs(value) < 1e7;
    std::snprintf(text, sizeof text, whole || large ? "%.0f" : "%.4g", value);
    return text;
}

const Quantity& quantity_of(const std::string& name)
{
    for (const Quantity& quantity : quantities)
        if (name == quantity.name) return quantity;
    throw Error(ErrorKind::bad_usage, "experiments.json: unknown quantity " + name);
}

}  // namespace pliant::tool::reproduce
