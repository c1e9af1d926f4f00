// `pliant bench`: what its suites share. A suite is a list of cases; a case measures something and adds rows.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pliant/scene.hpp"
#include "pliant/simulation.hpp"

namespace pliant::tool {

struct BenchOptions {
    std::string suite = "all";
    SimulationOptions simulation;
    std::string only;    ///< cases with this in their names alone
    bool quick = false;  ///< small cloths and few frames: to see that it works, not for figures
    std::string json_file, csv_file;
    std::vector<std::string> meshes;  ///< files, for the linear systems
};
int bench_command(const BenchOptions& options);

/// What a row asks for.
struct Bar {
    enum class Kind { none, at_most, at_least };
    Kind kind = Kind::none;
    double value = 0;

    bool met_by(double measured) const;
};
constexpr Bar at_most(double value) { return {Bar::Kind::at_most, value}; }
constexpr Bar at_least(double value) { return {Bar::Kind::at_least, value}; }

/// One number that was measured, and under which conditions.
struct BenchRow {
    std::string suite, subject, quantity, unit;
    double value = 0;
    Bar bar;
    std::string backend;
    unsigned threads = 0;
    std::uint64_t nodes = 0, springs = 0;
    double stiffness = 0;           ///< N/m, the largest
    double step = 0;                ///< s
    double real_time_factor = 0;    ///< simulated seconds per wall second
    std::optional<double> stretch;  ///< largest ever, (l - l0) / l0
    std::string remark = {};
};

/// What cases put their rows into.
class BenchTable {
public:
    /// The first part of a row, as the simulation that was measured tells it; `stiffness` in N/m.
    BenchRow row(const Simulation& simulation, const std::string& subject, double stiffness,
                 double stretch) const;
    void add(BenchRow row, const std::string& quantity, double value, const std::string& unit, Bar bar = {});

    void begin_suite(const std::string& suite) { suite_ = suite; }
    std::span<const BenchRow> rows() const { return rows_; }

private:
    std::string suite_;
    std::vector<BenchRow> rows_;
};

struct BenchCase {
    std::string name;
    std::function<void(BenchTable&)> measure;
};
std::vector<BenchCase> constraint_cases(const BenchOptions& options);
std::vector<BenchCase> acad_cases(const BenchOptions& options);
std::vector<BenchCase> stability_cases(const BenchOptions& options);

// Scenes (bench_scenes.cpp). Frames are 1/60 s.

/// A horizontal sheet of n x n nodes, 1 m x 1 m, let go; held at two corners. Structural and shear springs
/// are constraints of this compliance (m/N); bend springs of 1 N/m.
Scene hanging_sheet(std::uint32_t n, double compliance, double density = 0.3);
/// The same of an irregular triangle mesh of about this many nodes.
Scene hanging_mesh(std::uint32_t nodes, double compliance);
/// The same of the mesh in a file, which its first two vertices hold.
Scene hanging_file(const std::string& mesh_file, double compliance);
/// Makes bend springs constraints, too.
void bend_by_constraints(Scene& scene, double compliance);

double median_of(std::vector<double> values);
double milliseconds_to_advance(Simulation& simulation, double duration);

}  // namespace pliant::tool
