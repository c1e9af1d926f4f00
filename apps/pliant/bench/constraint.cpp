// The method constraint: iterations of its linear systems, the motion of hanging cloth, and the cost of a
// frame.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "bench/bench_command.hpp"
#include "bench/harness.hpp"
#include "pliant/extremes.hpp"
#include "simulation/linear_benchmark.hpp"

namespace pliant::tool {
namespace {

constexpr double goal = 1e-3;  // |r| / |r0|

std::string text_of(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}
std::string square(std::uint32_t n) { return std::to_string(n) + " x " + std::to_string(n); }

void remember_stretch(const Simulation& simulation, double& stretch)
{
    stretch = larger(stretch, simulation.report().measures.max_stretch);
}

// --- linear systems -------------------------------------------------------------------------------

/// State after six frames: smooth, in motion, and under load.
struct DrapedState {
    DrapedState(const Scene& scene, const SimulationOptions& options) : simulation(scene, options)
    {
        for (int k = 0; k < 6; ++k) {
            simulation.advance(frame);
            remember_stretch(simulation, stretch);
        }
    }
    LinearBenchmark system(Scene scene, Preconditioner preconditioner, std::uint32_t smoothing,
                           const SimulationOptions& options)
    {
        scene.newton_multigrid.resists = Resists::both;  // no spring is slack: the hardest operator
        scene.newton_multigrid.preconditioner = preconditioner;
        scene.newton_multigrid.smoothing = smoothing;
        return {scene,
                simulation.positions(),
                simulation.velocities(),
                simulation.step_length(),
                simulation.backend(),
                options};
    }

    Simulation simulation;
    double stretch = 0;
};

BenchCase cycles_case(const BenchOptions& options, const std::string& subject,
                      const std::function<Scene()>& scene, double compliance, double bar)
{
    return {subject, [=](BenchTable& table) {
                constexpr std::uint32_t most = 200;
                const Scene made = scene();
                DrapedState state(made, options.simulation);
                BenchRow row = table.row(state.simulation, subject, 1 / compliance, state.stretch);
                constexpr std::uint32_t judged = 3;  // the table also shows the time of fewer cycles
                for (const std::uint32_t smoothing : {1u, judged, 8u}) {
                    const auto solution =
                        state.system(made, Preconditioner::multigrid, smoothing, options.simulation)
                            .solve(goal, most);
                    row.remark =
                        solution.reached ? "" : "ended at |r| / |r0| = " + text_of(solution.residual);
                    const std::string with = ", smoothing " + std::to_string(smoothing);
                    table.add(row, "V-cycles" + with, solution.reached ? solution.iterations : most, "1",
                              smoothing == judged ? at_most(bar) : Bar{});
                    table.add(row, "time" + with, solution.milliseconds, "ms");
                }
            }};
}

void add_cycles(const BenchOptions& options, std::vector<BenchCase>& cases)
{
    std::vector<std::uint32_t> sheets = {33, 65, 129, 257, 513, 1025},
                               meshes = {2'500, 10'000, 40'000, 100'000};
    std::vector<double> compliances = {1e-8, 1e-6, 1e-4};
    if (options.quick) sheets = {17, 33}, meshes = {400}, compliances = {1e-6};
    for (const bool bend : {false, true})
        for (const std::uint32_t n : sheets)
            for (const double compliance : compliances)
                cases.push_back(cycles_case(
                    options, "linear system, " + square(n) + (bend ? ", all classes" : ", 2 classes"),
                    [=] {
                        Scene scene = hanging_sheet(n, compliance);
                        if (bend) bend_by_constraints(scene, compliance);
                        return scene;
                    },
                    compliance, 20));
    for (const std::uint32_t nodes : meshes)
        for (const double compliance : compliances)
            cases.push_back(cycles_case(
                options, "linear system, irregular mesh, " + std::to_string(nodes),
                [=] { return hanging_mesh(nodes, compliance); }, compliance, 25));
}

void add_files(const BenchOptions& options, std::vector<BenchCase>& cases)
{
    for (const std::string& file : options.meshes)
        for (const double compliance : {1e-8, 1e-6, 1e-4})
            cases.push_back(cycles_case(
                options, "linear system, " + std::filesystem::path(file).filename().string(),
                [=] { return hanging_file(file, compliance); }, compliance, 25));
}

/// The same system with the three preconditioners, alternating.
void add_preconditioners(const BenchOptions& options, std::vector<BenchCase>& cases)
{
    const std::uint32_t n = options.quick ? 24 : 128;
    const std::string subject = "preconditioners, " + square(n) + ", all classes";
    cases.push_back(
        {subject, [=](BenchTable& table) {
             constexpr double compliance = 1e-6;
             constexpr std::uint32_t most = 20'000;
             Scene scene = hanging_sheet(n, compliance);
             bend_by_constraints(scene, compliance);
             DrapedState state(scene, options.simulation);
             const bool far = state.simulation.backend() == Backend::vulkan;
             struct Way {
                 Preconditioner preconditioner;
                 const char* name;
                 std::uint32_t between;  // on a device a test costs more than an iteration without V-cycles
                 double bar;
                 std::vector<double> milliseconds = {};
                 LinearBenchmark::Solution solution = {};
             };
             std::vector<Way> ways = {{Preconditioner::multigrid, "multigrid", 1, 0},
                                      {Preconditioner::jacobi, "jacobi", far ? 16u : 1u, 8},
                                      {Preconditioner::none, "none", far ? 16u : 1u, 50}};
             std::vector<LinearBenchmark> systems;
             for (const Way& way : ways)
                 systems.push_back(state.system(scene, way.preconditioner, scene.newton_multigrid.smoothing,
                                                options.simulation));
             for (int turn = 0; turn < 4; ++turn)
                 for (std::size_t k = 0; k < ways.size(); ++k) {
                     ways[k].solution = systems[k].solve(goal, most, ways[k].between);
                     if (turn > 0) ways[k].milliseconds.push_back(ways[k].solution.milliseconds);
                 }
             const double multigrid = median_of(ways[0].milliseconds);
             BenchRow row = table.row(state.simulation, subject, 1 / compliance, state.stretch);
             for (const Way& way : ways) {
                 const double ms = median_of(way.milliseconds);
                 row.remark =
                     std::to_string(way.solution.iterations) + " iterations" +
                     (way.solution.reached ? ""
                                           : ", ended at |r| / |r0| = " + text_of(way.solution.residual));
                 table.add(row, std::string("time, ") + way.name, ms, "ms");
                 if (way.bar > 0)
                     table.add(row, std::string("time, ") + way.name + " / multigrid", ms / multigrid, "1",
                               at_least(way.bar));
             }
         }});
}

// --- hanging --------------------------------------------------------------------------------------

/// The motion of a sheet after its release.
struct Fall {
    std::array<double, 3> heights{};  ///< m, of the middle of the free edge after 15, 30 and 45 frames
    double energy = 0;                ///< J, after 1 s
    double stretch = 0, stretch_late = 0, speed_late = 0;
    StepTime time;  ///< of a frame
};

Fall let_fall(Simulation& simulation, std::uint32_t n, int frames)
{
    Fall fall;
    std::vector<double> milliseconds;
    for (int k = 1; k <= frames; ++k) {
        milliseconds.push_back(milliseconds_to_advance(simulation, frame));
        const FrameMeasures& m = simulation.report().measures;
        remember_stretch(simulation, fall.stretch);
        if (k > frames - 60) {
            remember_stretch(simulation, fall.stretch_late);
            fall.speed_late = larger(fall.speed_late, m.max_speed);
        }
        if (k % 15 == 0 && k <= 45) {
            const auto x = simulation.positions();
            const std::size_t last_row = std::size_t{n - 1} * n;
            fall.heights[static_cast<std::size_t>(k / 15 - 1)] =
                0.5 * (double{x[last_row + (n - 1) / 2].y} + double{x[last_row + n / 2].y});
        }
        if (k == 60) fall.energy = m.kinetic_energy + m.potential_energy + m.elastic_energy;
    }
    fall.time = step_time_of(milliseconds);
    return fall;
}

/// Converged reference runs; each is made on first use.
class ConvergedFalls {
public:
    explicit ConvergedFalls(const BenchOptions& options) : options_(options) {}

    const Fall& operator()(std::uint32_t n, double stiffness, double density)
    {
        Fall& fall = falls_[{n, stiffness, density}];
        if (fall.time.median > 0) return fall;
        Scene scene = hanging_sheet(n, 1 / stiffness, density);
        scene.newton_multigrid.newton_iterations = 40;
        scene.newton_multigrid.newton_tolerance = 0.003;
        scene.newton_multigrid.linear_iterations = 60;
        scene.newton_multigrid.linear_tolerance = 0.02;
        Simulation simulation(scene, options_.simulation);
        return fall = let_fall(simulation, n, 60);
    }

private:
    BenchOptions options_;
    std::map<std::tuple<std::uint32_t, double, double>, Fall> falls_;
};

struct HangingSize {
    std::uint32_t n;
    double stiffness, density;
    std::vector<double> frames_per_second;  ///< bars: for a useful and for a fast frame rate
};

BenchRow fall_row(BenchTable& table, Simulation& simulation, const std::string& subject, double stiffness,
                  const Fall& fall)
{
    BenchRow row = table.row(simulation, subject, stiffness, fall.stretch);
    row.series = "hanging sheet, constraint";
    row.time = fall.time;
    return row;
}

BenchCase hanging_case(const BenchOptions& options, const HangingSize& size,
                       const std::shared_ptr<ConvergedFalls>& converged)
{
    const std::string subject = "hanging, " + square(size.n) + ", " + text_of(size.density) + " kg/m2";
    return {subject, [=](BenchTable& table) {
                const Scene scene = hanging_sheet(size.n, 1 / size.stiffness, size.density);
                Simulation simulation(scene, options.simulation);
                const Fall fall = let_fall(simulation, size.n, options.quick ? 60 : 600);
                const BenchRow row = fall_row(table, simulation, subject, size.stiffness, fall);
                table.add(row, "stretch, ever", 100 * fall.stretch, "%", at_most(1));
                table.add(row, "stretch, last second", 100 * fall.stretch_late, "%", at_most(0.5));
                const Fall& exact = (*converged)(options.quick ? 16 : 64, size.stiffness, size.density);
                constexpr std::array height_bars = {0.5, 1.0, 2.0};
                for (std::size_t k = 0; k < height_bars.size(); ++k)
                    table.add(row, "height off, frame " + std::to_string(15 * (k + 1)),
                              100 * std::abs(fall.heights[k] - exact.heights[k]), "cm",
                              at_most(height_bars[k]));
                for (const double asked_for : size.frames_per_second)
                    table.add(row, "frames", 1000 / fall.time.median, "1/s", at_least(asked_for));
                const SolverReport& solver = simulation.report().solver;
                table.add(row, "Newton iterations per frame", solver.newton_mean, "1");
                table.add(row, "V-cycles per frame", solver.iterations_mean, "1");
                table.add(row, "speed, last second", fall.speed_late, "m/s");
                if (size.n > 64) return;
                const double scale = size.density * 9.81;  // m g L of 1 m x 1 m
                const Fall& same = (*converged)(size.n, size.stiffness, size.density);
                table.add(row, "energy off after 1 s, of m g L",
                          100 * std::abs(fall.energy - same.energy) / scale, "%", at_most(0.5));
            }};
}

void add_hanging(const BenchOptions& options, std::vector<BenchCase>& cases)
{
    std::vector<HangingSize> sizes = {{32, 1e6, 0.3, {}},          {64, 1e6, 0.3, {}},
                                      {128, 1e6, 0.3, {220, 300}}, {128, 1e6, 1.0, {}},
                                      {256, 1e6, 0.3, {40, 55}},   {512, 1e6, 0.3, {8}}};
    if (options.quick) sizes = {{16, 1e6, 0.3, {}}, {24, 2e5, 1.0, {}}};
    if (!options.sizes.empty()) sizes.clear();
    for (const std::uint64_t nodes : options.sizes) {
        const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(nodes))));
        sizes.push_back({n, 1e6, 0.3, {}});
    }
    const auto converged = std::make_shared<ConvergedFalls>(options);
    for (const HangingSize& size : sizes) cases.push_back(hanging_case(options, size, converged));
}

/// Air damps the swing, and the sheet comes to rest.
void add_rest(const BenchOptions& options, std::vector<BenchCase>& cases)
{
    const std::uint32_t n = options.quick ? 16 : 128;
    const std::string subject = "coming to rest, " + square(n) + ", damping 1/s";
    cases.push_back({subject, [=](BenchTable& table) {
                         Scene scene = hanging_sheet(n, 1e-6);
                         scene.cloth_handle(0)->damping = 1;
                         Simulation simulation(scene, options.simulation);
                         const Fall fall = let_fall(simulation, n, options.quick ? 120 : 600);
                         const BenchRow row = fall_row(table, simulation, subject, 1e6, fall);
                         table.add(row, "speed, last second", fall.speed_late, "m/s",
                                   options.quick ? Bar{} : at_most(0.03));
                         table.add(row, "stretch, last second", 100 * fall.stretch_late, "%", at_most(0.5));
                     }});
}

void add_garments(const BenchOptions& options, std::vector<BenchCase>& cases)
{
    const auto garments = garment_cases(options);
    cases.insert(cases.end(), garments.begin(), garments.end());
}

// --- one core -------------------------------------------------------------------------------------

/// Measured beside Pliant on one machine on 2026-11-30, one thread: NvCloth took 15.9 ms per frame of the
/// sheet of 96 x 96 nodes and 1 kg, at 5.6 % of stretch (80 substeps); Pliant took 7.8 ms, at 0.22 %.
void add_one_thread(BenchOptions options, std::vector<BenchCase>& cases)
{
    options.simulation.threads = 1;
    const std::uint32_t large = options.quick ? 24 : 96, small = options.quick ? 16 : 34;
    const int frames = options.quick ? 30 : 600;
    const std::string large_name = "one thread, " + square(large) + ", 1 kg";
    cases.push_back({large_name, [=](BenchTable& table) {
                         Simulation simulation(hanging_sheet(large, 1e-6, 1.0), options.simulation);
                         const Fall fall = let_fall(simulation, large, frames);
                         const BenchRow row = fall_row(table, simulation, large_name, 1e6, fall);
                         table.add(row, "frame", fall.time.median, "ms", at_most(17));
                         table.add(row, "stretch, ever", 100 * fall.stretch, "%", at_most(1));
                     }});
    const std::string small_name = "one thread, " + square(small) + ", 0.3 kg";
    cases.push_back({small_name, [=](BenchTable& table) {
                         Simulation simulation(hanging_sheet(small, 1e-6), options.simulation);
                         const Fall fall = let_fall(simulation, small, frames);
                         const BenchRow row = fall_row(table, simulation, small_name, 1e6, fall);
                         table.add(row, "frames", 1000 / fall.time.median, "1/s", at_least(300));
                         table.add(row, "stretch, ever", 100 * fall.stretch, "%", at_most(0.5));
                     }});
}

// --- a GPU ----------------------------------------------------------------------------------------

/// Steps of one linear system each, or up to three if one does not solve the step, each to the given
/// tolerance: a million nodes, six million constraints, if a GPU has the memory.
void add_million(const BenchOptions& options, std::vector<BenchCase>& cases)
{
    const auto devices = list_devices();
    const bool gpu = std::any_of(devices.begin(), devices.end(), [](const DeviceListing& device) {
        return device.backend == Backend::vulkan && device.kind != "software";
    });
    const Backend backend = options.simulation.backend;
    if (!options.quick && (!gpu || (backend != Backend::vulkan && backend != Backend::automatic))) return;
    const std::uint32_t n = options.quick ? 24 : 1000;
    const std::string subject = "one to three systems a step, " + square(n) + ", all classes";
    cases.push_back({subject, [=](BenchTable& table) {
                         Scene scene = hanging_sheet(n, 1e-6);
                         bend_by_constraints(scene, 1e-6);
                         scene.newton_multigrid.newton_iterations = 1;
                         scene.newton_multigrid.step_cuts = 0;
                         scene.newton_multigrid.linear_tolerance = goal;
                         scene.newton_multigrid.linear_iterations = 60;
                         Simulation simulation(scene, options.simulation);
                         const Fall fall = let_fall(simulation, n, 12);
                         BenchRow row = fall_row(table, simulation, subject, 1e6, fall);
                         row.series = "hanging sheet, one to three systems a step";
                         table.add(row, "steps", 1000 / fall.time.median, "1/s",
                                   options.quick ? Bar{} : at_least(60));
                         table.add(row, "systems per step", simulation.report().solver.newton_mean, "1");
                     }});
}

}  // namespace

std::vector<BenchCase> constraint_cases(const BenchOptions& options)
{
    std::vector<BenchCase> cases;
    if (!options.sizes.empty()) {
        add_hanging(options, cases);
        add_garments(options, cases);
        return cases;
    }
    add_cycles(options, cases);
    add_files(options, cases);
    add_preconditioners(options, cases);
    add_hanging(options, cases);
    add_rest(options, cases);
    add_garments(options, cases);
    add_one_thread(options, cases);
    add_million(options, cases);
    return cases;
}

}  // namespace pliant::tool
