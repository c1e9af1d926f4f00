#include "record/run_record.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <nlohmann/json.hpp>

#include "files/formatted.hpp"
#include "pliant/extremes.hpp"

namespace pliant {
namespace {

/// The object "solver" of the summary.
nlohmann::ordered_json solver_summary(const Scene& scene, const SolverReport& report)
{
    return {{"name", name_of(scene.solver)},
            {"newton_mean", report.newton_mean},
            {"newton_max", report.newton_max},
            {"iterations_mean", report.iterations_mean},
            {"iterations_max", report.iterations_max},
            {"residual_max", report.residual_max},
            {"frames_cut", report.frames_cut},
            {"steps_added", report.steps_added},
            {"searches_refused", report.searches_refused},
            {"energy_lost", report.energy_lost},
            {"active_mean", report.active_mean},
            {"active_max", report.active_max}};
}

}  // namespace

StatisticsFile::StatisticsFile(const std::filesystem::path& file, std::size_t bodies) : file_(file)
{
    file_.stream()
        << "frame,time_s,max_stretch,mean_stretch,max_penetration_m,max_speed_m_per_s,kinetic_energy_J,"
           "elastic_energy_J,potential_energy_J,non_finite_nodes,wall_ms,newton,iterations,residual,"
           "active_constraints,energy_lost_J";
    if (bodies > 0) file_.stream() << ",volume_error";
    for (std::size_t k = 0; k < bodies; ++k) file_.stream() << ",volume_" << k << "_m3";
    file_.stream() << '\n';
}

void StatisticsFile::add(const Report& report, double wall_milliseconds)
{
    const FrameMeasures& m = report.measures;
    char line[512];
    const SolverReport& s = report.solver;
    std::snprintf(
        line, sizeof line, "%llu,%.9g,%.6g,%.6g,%.6g,%.6g,%.9g,%.9g,%.9g,%llu,%.4g,%u,%u,%.6g,%llu,%.9g",
        static_cast<unsigned long long>(report.frames), report.simulated_seconds, m.max_stretch,
        m.mean_stretch, m.max_penetration, m.max_speed, m.kinetic_energy, m.elastic_energy,
        m.potential_energy, static_cast<unsigned long long>(m.non_finite), wall_milliseconds, s.newton_last,
        s.iterations_last, s.residual_last, static_cast<unsigned long long>(s.active_last), s.energy_lost);
    file_.stream() << line;
    if (!report.bodies.empty()) {
        double error = 0;
        for (const BodyMeasures& body : report.bodies)
            if (!(std::abs(body.error) <= std::abs(error))) error = body.error;
        std::snprintf(line, sizeof line, ",%.6g", error);
        file_.stream() << line;
    }
    for (const BodyMeasures& body : report.bodies) {
        std::snprintf(line, sizeof line, ",%.9g", body.volume);
        file_.stream() << line;
    }
    file_.stream() << '\n';
}

void RunSummary::add_frame(const Report& report)
{
    frames_.push_back({report.simulated_seconds, report.measures.max_stretch, report.measures.mean_stretch});
    max_stretch_peak_ = larger(max_stretch_peak_, report.measures.max_stretch);
    max_penetration_ = larger(max_penetration_, report.measures.max_penetration);
}

double RunSummary::max_stretch(double until) const
{
    double most = frames_.empty() ? 0 : frames_.back().max;
    for (const FrameStretch& frame : frames_)
        if (frame.time > until - 1) most = larger(most, frame.max);
    return most;
}

double RunSummary::mean_stretch(double until) const
{
    double sum = 0, count = 0;
    for (const FrameStretch& frame : frames_)
        if (frame.time > until - 1) sum += frame.mean, count += 1;
    return count > 0 ? sum / count : 0;
}

std::map<std::string, double> RunSummary::values(Simulation& simulation) const
{
    const Report& report = simulation.report();
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (std::size_t c = 0; c < simulation.scene().cloth_count(); ++c)
        for (const Vec3& x : simulation.positions(c)) {
            lowest = smaller(lowest, x.y);
            highest = larger(highest, x.y);
        }
    const double wall = std::max(report.wall_seconds, 1e-9);
    double ratio = 0;
    for (const BodyMeasures& body : report.bodies)
        ratio += body.ratio / static_cast<double>(report.bodies.size());
    return {{"nodes", static_cast<double>(simulation.node_count())},
            {"springs", static_cast<double>(simulation.spring_count())},
            {"triangles", static_cast<double>(simulation.triangle_count())},
            {"frames", static_cast<double>(report.frames)},
            {"steps", static_cast<double>(report.steps)},
            {"simulated_seconds", report.simulated_seconds},
            {"frames_per_second", static_cast<double>(report.frames) / wall},
            {"real_time_factor", report.simulated_seconds / wall},
            {"max_stretch", max_stretch(report.simulated_seconds)},
            {"max_stretch_peak", max_stretch_peak_},
            {"mean_stretch", mean_stretch(report.simulated_seconds)},
            {"max_penetration", max_penetration_},
            {"kinetic_energy", report.measures.kinetic_energy},
            {"elastic_energy", report.measures.elastic_energy},
            {"lowest_height", lowest},
            {"highest_height", highest},
            {"finite", report.finite ? 1.0 : 0.0},
            {"solver.newton_mean", report.solver.newton_mean},
            {"solver.iterations_mean", report.solver.iterations_mean},
            {"solver.iterations_max", static_cast<double>(report.solver.iterations_max)},
            {"solver.residual_max", report.solver.residual_max},
            {"solver.energy_lost", report.solver.energy_lost},
            {"solver.active_max", static_cast<double>(report.solver.active_max)},
            {"volume_error_max", report.volume.error_max},
            {"volume_loss_max", report.volume.loss_max},
            {"volume_gain_max", report.volume.gain_max},
            {"volume_loss_mean", report.volume.loss_mean},
            {"volume_ratio_final", ratio}};
}

bool has_diverged(const FrameMeasures& measures) { return measures.max_stretch > 1000; }

std::vector<std::string> RunSummary::warnings(const Simulation& simulation) const
{
    std::vector<std::string> sentences;
    const Scene& scene = simulation.scene();
    const SolverReport& solver = simulation.report().solver;
    if (solver.used() && !solver.is_solved())
        sentences.push_back(
            formatted("steps were not solved: the largest residual is %.3g of the load of its "
                      "step; take more iterations (--set newton_multigrid.newton_iterations=N) or, where "
                      "steps are longer than 1/60 s, more substeps (--set time.substeps=N)",
                      solver.residual_max));
    double limit = 0, thickness = 0;
    bool constrains_all = true;  // whose stretch is measured
    for (std::size_t c = 0; c < scene.cloth_count(); ++c) {
        const Springs& springs = scene.cloth(c).springs;
        limit = std::max({limit, springs.structural.limit, springs.shear.limit});
        for (const SpringRole role : {springs.structural.role, springs.shear.role})
            constrains_all &= role != SpringRole::spring;
        thickness = std::max(thickness, scene.cloth(c).thickness);
    }
    constexpr double room = 0.02;
    if (solver.used() && scene.method == Method::constraint && constrains_all &&
        max_stretch_peak_ > limit + room)
        sentences.push_back(
            formatted("constraints were stretched by %.3g %%: pins and colliders pull the "
                      "cloth further than it reaches, or faster than a step can follow",
                      100 * max_stretch_peak_));
    constexpr double noticeable = 0.005;  // m, beyond the thickness
    if (max_penetration_ > std::max(thickness + noticeable, start_penetration_))
        sentences.push_back(
            formatted("nodes were up to %.3g m inside colliders: the cloth is pulled or "
                      "pushed there harder than contact holds, or faster than a step can "
                      "follow; take more substeps (--set time.substeps=N), or give the "
                      "cloth room",
                      max_penetration_ - thickness));
    return sentences;
}

void RunSummary::write(const std::filesystem::path& file, Simulation& simulation, double wall_seconds) const
{
    const auto numbers = values(simulation);
    nlohmann::ordered_json summary;
    summary["scene"] = simulation.scene().name;
    summary["method"] = name_of(simulation.scene().method);
    summary["backend"] = name_of(simulation.backend());
    summary["device"] = simulation.device_name();
    summary["threads"] = simulation.thread_count();
    for (const char* key : {"nodes", "springs", "triangles", "frames", "steps"})
        summary[key] = static_cast<std::uint64_t>(numbers.at(key));
    summary["simulated_seconds"] = simulation.report().simulated_seconds;
    summary["step_seconds"] = simulation.step_length();
    summary["stable_step_seconds"] = std::isfinite(simulation.stable_step())
                                         ? nlohmann::ordered_json(simulation.stable_step())
                                         : nlohmann::ordered_json(nullptr);
    summary["wall_seconds"] = wall_seconds;
    summary["simulation_seconds"] = simulation.report().wall_seconds;
    for (const char* key :
         {"frames_per_second", "real_time_factor", "max_stretch", "max_stretch_peak", "mean_stretch",
          "max_penetration", "kinetic_energy", "elastic_energy", "lowest_height", "highest_height"})
        summary[key] = numbers.at(key);
    if (simulation.body_count() > 0) {
        for (const char* key : {"volume_error_max", "volume_loss_max", "volume_gain_max", "volume_loss_mean",
                                "volume_ratio_final"})
            summary[key] = numbers.at(key);
        summary["volume_misses"] = simulation.report().volume.misses;
    }
    summary["finite"] = simulation.report().finite;
    auto all = simulation.warnings();
    for (std::string& sentence : warnings(simulation)) all.push_back(std::move(sentence));
    summary["warnings"] = all;
    summary["state_hash"] = hash_text(simulation.state_hash());
    const SolverReport& solver = simulation.report().solver;
    if (solver.used()) summary["solver"] = solver_summary(simulation.scene(), solver);
    auto& passes = summary["passes"] = nlohmann::ordered_json::object();
    for (const PassTime& pass : simulation.pass_times()) passes[pass.name] = pass.milliseconds;

    write_text_file(file, summary.dump(2) + "\n");
}

std::vector<std::string> failed_checks(const Scene& scene, const std::map<std::string, double>& values)
{
    std::vector<std::string> failures;
    for (const Check& check : scene.checks) {
        const auto found = values.find(check.value);
        if (found == values.end()) continue;  // the reader accepts only names of the summary
        if (found->second >= check.min && found->second <= check.max) continue;
        char text[256];
        std::snprintf(text, sizeof text, "%s is %.6g, but the scene requires %.6g to %.6g",
                      check.value.c_str(), found->second, check.min, check.max);
        failures.emplace_back(text);
    }
    return failures;
}

std::string hash_text(std::uint64_t hash)
{
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

}  // namespace pliant
