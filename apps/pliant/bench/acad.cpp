// ACAD compared with the methods mass_spring and constraint, and the range of steps, stiffnesses and masses
// in which every method is stable.
#include <algorithm>
#include <cmath>

#include "bench/bench_command.hpp"
#include "bench/harness.hpp"
#include "pliant/extremes.hpp"

namespace pliant::tool {
namespace {

/// N/m, of all classes: a sheet of 32 x 32 nodes stretches springs beyond 10 % if it hangs from two corners,
/// but not if it hangs from an edge.
constexpr double sheet_stiffness = 400;

/// A sheet of springs alone, 1 m x 1 m, released from the horizontal.
Scene hung_springs(std::uint32_t n, bool by_corners)
{
    Scene scene;
    Cloth cloth = Cloth::sheet({.rows = n, .columns = n, .width = 1, .height = 1, .density = 0.3});
    cloth.springs = {{sheet_stiffness, 0}, {sheet_stiffness, 0}, {sheet_stiffness, 0}};
    if (by_corners)
        cloth.pin(Corner::top_left).pin(Corner::top_right);  // which bear the whole sheet, so that springs
                                                             // there stretch
    else
        cloth.pin(Edge::top);
    scene.add(std::move(cloth));
    return scene;
}

/// The steps per frame that its springs need.
std::uint32_t steps_of(const Scene& scene, const SimulationOptions& options)
{
    return Simulation(scene, options).steps_per_frame();
}

/// A sheet pinned at an edge, its middle displaced to one side by part of a spring's length.
Scene pulled_springs(std::uint32_t n)
{
    constexpr double part = 0.75, seconds = 0.1;
    Scene scene = hung_springs(n, false);
    scene.gravity = {0, 0, 0};
    const double moved = part / (n - 1);
    scene.cloth_handle(0).pin(
        Attachment(n / 2 * n + n / 2, {{.time = 0}, {.time = seconds, .position = {moved, 0, 0}}}));
    return scene;
}

/// The cost of limits: while none is needed, or while few are, around one node. The two methods alternate,
/// frame by frame.
BenchCase readiness_case(const BenchOptions& options, bool pulled)
{
    const std::uint32_t n = options.quick ? 24 : 128;
    const std::string subject = (pulled ? "springs over 10 % around one node, " : "no spring over 10 %, ") +
                                std::to_string(n) + " x " + std::to_string(n);
    return {subject, [=](BenchTable& table) {
                Scene scene = pulled ? pulled_springs(n) : hung_springs(n, false);
                scene.time.substeps = steps_of(scene, options.simulation);
                Simulation springs(scene, options.simulation);
                scene.method = Method::acad;
                Simulation acad(scene, options.simulation);
                std::vector<double> ratios, of_springs, of_acad;
                double stretch = 0;
                const int frames = options.quick ? 10 : 60;
                for (int k = 0; k < frames + 2; ++k) {
                    const double one = milliseconds_to_advance(springs, frame);
                    const double other = milliseconds_to_advance(acad, frame);
                    stretch = larger(stretch, acad.report().measures.max_stretch);
                    const bool counts = pulled ? acad.report().solver.active_max > 0 : k >= 2;
                    if (!counts)
                        continue;  // warm-up: programs are made, memory is touched; nothing is
                                   // pulled yet
                    of_springs.push_back(one / scene.time.substeps);
                    of_acad.push_back(other / scene.time.substeps);
                    ratios.push_back(other / one);
                }
                BenchRow row = table.row(springs, subject, sheet_stiffness, stretch);
                row.in_plot = false;
                row.time = step_time_of(of_springs);
                table.add(row);
                row = table.row(acad, subject, sheet_stiffness, stretch);
                const auto& solver = acad.report().solver;
                if (solver.active_max > 0)
                    row.remark = std::to_string(solver.active_max) + " constraints were active";
                row.in_plot = false;
                row.time = step_time_of(of_acad);
                if (pulled)
                    table.add(row, "acad / mass_spring, few active", median_of(ratios), "1");
                else
                    table.add(row, "acad / mass_spring", median_of(ratios), "1", at_most(1.15));
            }};
}

/// Figure 10 of the cloth paper: ACAD compared with all springs as constraints, with the same solver.
BenchCase figure_10_case(const BenchOptions& options, bool by_corners)
{
    const std::uint32_t n = options.quick ? 12 : 32;
    const std::string subject = "figure 10, " + std::to_string(n) + " x " + std::to_string(n) +
                                (by_corners ? ", held at two corners" : ", held at an edge");
    return {subject, [=](BenchTable& table) {
                Scene scene = hung_springs(n, by_corners);
                scene.time.substeps = steps_of(scene, options.simulation);
                const int frames = options.quick ? 10 : 120;
                struct Way {
                    Method method;
                    Solver solver;
                    const char* name;
                };
                constexpr int least_frames = 10;
                constexpr double patience = 20;  // s; constraints alone take seconds per frame
                double constraints_alone = 0;
                for (const Way& way :
                     {Way{Method::constraint, Solver::paper, "constraint, solver paper"},
                      Way{Method::acad, Solver::paper, "acad, solver paper"},
                      Way{Method::acad, Solver::newton_multigrid, "acad, solver newton_multigrid"}}) {
                    Scene made = scene;
                    made.method = way.method;
                    made.solver = way.solver;
                    Simulation simulation(made, options.simulation);
                    std::vector<double> milliseconds;
                    double stretch = 0;
                    for (int k = 0; k < frames && simulation.report().finite; ++k) {
                        if (k >= least_frames && simulation.report().wall_seconds > patience) break;
                        milliseconds.push_back(milliseconds_to_advance(simulation, frame));
                        stretch = larger(stretch, simulation.report().measures.max_stretch);
                    }
                    const double rate = 1000 / median_of(milliseconds);
                    BenchRow row = table.row(simulation, subject, sheet_stiffness, stretch);
                    for (double& each : milliseconds) each /= scene.time.substeps;
                    row.in_plot = false;
                    row.time = step_time_of(milliseconds);
                    row.remark =
                        simulation.report().finite
                            ? std::to_string(simulation.report().frames) + " frames; at most " +
                                  std::to_string(simulation.report().solver.active_max) +
                                  " constraints active; " +
                                  std::to_string(std::lround(simulation.report().solver.iterations_mean)) +
                                  " linear iterations per step"
                            : "diverged";
                    table.add(row, std::string("frames, ") + way.name, rate, "1/s");
                    if (way.method == Method::constraint)
                        constraints_alone = rate;
                    else
                        table.add(row, std::string(way.name) + " / constraint", rate / constraints_alone, "1",
                                  at_least(206.0 / 32));  // frames per second that the paper reports
                }
            }};
}

struct StabilityPoint {
    Method method;
    double step, stiffness, node_mass;  ///< s, N/m, kg
};

/// A sheet that falls on a sphere and slides to the ground.
Scene stability_scene(const StabilityPoint& point, std::uint32_t n)
{
    Scene scene;
    scene.method = point.method;
    scene.time.frame_rate = 1 / point.step;
    scene.time.substeps = 1;
    Cloth cloth =
        Cloth::sheet({.rows = n, .columns = n, .width = 1, .height = 1, .node_mass = point.node_mass});
    cloth.position = {0.06, 0.95, 0.02};
    for (SpringParameters* springs : {&cloth.springs.structural, &cloth.springs.shear}) {
        *springs = {point.method == Method::constraint ? 0 : point.stiffness, 0};
        springs->compliance = 1 / point.stiffness;
    }
    cloth.springs.bend = {1, 0};
    scene.add(std::move(cloth));
    scene.add(Sphere{.centre = {0, 0.5, 0}, .radius = 0.3, .friction = 0.2});
    scene.add(Plane{.friction = 0.5});
    return scene;
}

BenchCase stability_case(const BenchOptions& options, const StabilityPoint& point)
{
    const std::uint32_t n = options.quick ? 16 : 32;
    char text[96];
    std::snprintf(text, sizeof text, "%s, %u x %u, nodes of %g kg", name_of(point.method), n, n,
                  point.node_mass);
    const std::string subject = text;
    return {subject, [=](BenchTable& table) {
                Simulation simulation(stability_scene(point, n), options.simulation);
                const Report& report = simulation.report();
                const auto frames = std::lround((options.quick ? 0.5 : 5.0) / point.step);
                double stretch = 0;
                for (long k = 0; k < frames && report.finite && !report.device_lost; ++k) {
                    simulation.advance(point.step);
                    if (report.finite) stretch = larger(stretch, report.measures.max_stretch);
                }
                BenchRow row = table.row(simulation, subject, point.stiffness, stretch);
                if (!report.finite) row.remark = "until frame " + std::to_string(report.bad_frame);
                table.add(row, "finite", report.finite && !report.device_lost ? 1 : 0, "1", at_least(1));
            }};
}

}  // namespace

std::vector<BenchCase> acad_cases(const BenchOptions& options)
{
    return {readiness_case(options, false), readiness_case(options, true), figure_10_case(options, true),
            figure_10_case(options, false)};
}

std::vector<BenchCase> stability_cases(const BenchOptions& options)
{
    std::vector<double> rates = {240, 120, 60, 30}, stiffnesses = {10, 1e3, 1e5, 1e7},
                        masses = {1e-4, 1e-2, 1, 10};
    if (options.quick) rates = {120, 30}, stiffnesses = {10, 1e7}, masses = {1e-4, 10};
    std::vector<BenchCase> cases;
    for (const Method method : {Method::constraint, Method::acad})
        for (const double rate : rates)
            for (const double stiffness : stiffnesses)
                for (const double mass : masses)
                    cases.push_back(stability_case(options, {method, 1 / rate, stiffness, mass}));
    return cases;
}

}  // namespace pliant::tool
