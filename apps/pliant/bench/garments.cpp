// Garments with the method constraint, each compared with a sheet of as many nodes.
#include <cmath>
#include <string>
#include <vector>

#include "bench/bench_command.hpp"
#include "bench/harness.hpp"
#include "pliant/extremes.hpp"

namespace pliant::tool {
namespace {

struct Garment {
    const char* name;
    Scene (*of_nodes)(std::uint32_t);
};
constexpr double sheet_compliance = 1e-6;  // m/N, the same for all
Scene square_of_nodes(std::uint32_t nodes) { return hanging_mesh(nodes, sheet_compliance); }
constexpr Garment garments[] = {{"disc", &hanging_disc},
                                {"irregular square", &square_of_nodes},
                                {"tube", &hanging_tube},
                                {"T-shirt", &hanging_shirt}};

/// A hanging piece, and its frames.
struct Hanging {
    Hanging(const Scene& scene, const SimulationOptions& options) : simulation(scene, options) {}
    void advance()
    {
        milliseconds.push_back(milliseconds_to_advance(simulation, frame));
        stretch = larger(stretch, simulation.report().measures.max_stretch);
    }

    Simulation simulation;
    std::vector<double> milliseconds;
    double stretch = 0;
};

/// Both simulations alternate, frame by frame, so that other load on the machine affects both.
BenchCase garment_case(const BenchOptions& options, const Garment& garment, std::uint32_t nodes)
{
    const std::string subject =
        "garment, " + std::string(garment.name) + ", " + std::to_string(nodes) + " nodes";
    return {subject, [=](BenchTable& table) {
                const Scene scene = garment.of_nodes(nodes);
                Hanging piece(scene, options.simulation);
                const auto count = static_cast<double>(piece.simulation.positions().size());
                const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(count)));
                Hanging sheet(hanging_sheet(n, sheet_compliance), options.simulation);
                const int frames = options.quick ? 20 : 300;
                std::vector<double> ratios;
                for (int k = 0; k < frames; ++k) {
                    piece.advance();
                    sheet.advance();
                    ratios.push_back(piece.milliseconds.back() / sheet.milliseconds.back());
                }
                BenchRow row = table.row(piece.simulation, subject, 1 / sheet_compliance, piece.stretch);
                row.series = std::string("hanging ") + garment.name;
                row.time = step_time_of(piece.milliseconds);
                table.add(row, "frames", 1000 / row.time->median, "1/s");
                table.add(row, "frames, sheet of " + std::to_string(n) + " x " + std::to_string(n),
                          1000 / median_of(sheet.milliseconds), "1/s");
                table.add(row, "time / sheet's", median_of(ratios), "1");
                table.add(row, "stretch, ever", 100 * piece.stretch, "%", at_most(1));
                table.add(row, "stretch of the sheet, ever", 100 * sheet.stretch, "%");
                const SolverReport& solver = piece.simulation.report().solver;
                table.add(row, "Newton iterations per frame", solver.newton_mean, "1");
                table.add(row, "V-cycles per frame", solver.iterations_mean, "1");
            }};
}

}  // namespace

std::vector<BenchCase> garment_cases(const BenchOptions& options)
{
    std::vector<std::uint64_t> sizes = options.sizes;
    if (sizes.empty()) sizes = {options.quick ? 320u : 16'000u};
    std::vector<BenchCase> cases;
    for (const std::uint64_t nodes : sizes)
        for (const Garment& garment : garments)
            cases.push_back(garment_case(options, garment, static_cast<std::uint32_t>(nodes)));
    return cases;
}

}  // namespace pliant::tool
