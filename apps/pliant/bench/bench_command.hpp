// `pliant bench`: shared by its suites. A suite is a list of cases; a case measures something and adds rows.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/table.hpp"
#include "pliant/scene.hpp"
#include "pliant/simulation.hpp"

namespace pliant::tool {

struct BenchOptions {
    std::string suite = "all";
    SimulationOptions simulation;
    std::string only;                  ///< only cases with this in their names
    std::vector<std::uint64_t> sizes;  ///< nodes; empty: each suite's own sizes
    bool quick = false;                ///< small cloths and few frames: a test run, without meaningful
                                       ///< figures
    std::string json_file, csv_file, plot_file;
    std::vector<std::string> meshes;  ///< files, for the linear systems and soft bodies
};
int bench_command(const BenchOptions& options);

struct BenchCase {
    std::string name;
    std::function<void(BenchTable&)> measure;
};
std::vector<BenchCase> mass_spring_cases(const BenchOptions& options);
std::vector<BenchCase> constraint_cases(const BenchOptions& options);
std::vector<BenchCase> acad_cases(const BenchOptions& options);
std::vector<BenchCase> volume_cases(const BenchOptions& options);
std::vector<BenchCase> garment_cases(const BenchOptions& options);  ///< of the suite constraint
std::vector<BenchCase> stability_cases(const BenchOptions& options);

// Scenes (bench_scenes.cpp). Frames are 1/60 s.

/// A horizontal sheet of n x n nodes, 1 m x 1 m, pinned at two corners and released. Structural and shear
/// springs are constraints of this compliance (m/N); bend springs have 1 N/m.
Scene hanging_sheet(std::uint32_t n, double compliance, double density = 0.3);
/// The same with an irregular triangle mesh of about this many nodes.
Scene hanging_mesh(std::uint32_t nodes, double compliance);
/// The same with the mesh of a file, pinned at its first two vertices.
Scene hanging_file(const std::string& mesh_file, double compliance);
/// Garments of about `nodes` nodes, released from the horizontal and pinned at two nodes: a disc of 1 m, a
/// tube 1 m long pinned at one end, a T-shirt 0.5 m wide pinned at its shoulders. Compliance 1e-6 m/N.
Scene hanging_disc(std::uint32_t nodes);
Scene hanging_tube(std::uint32_t nodes);
Scene hanging_shirt(std::uint32_t nodes);
/// Makes bend springs constraints, too.
void bend_by_constraints(Scene& scene, double compliance);

double milliseconds_to_advance(Simulation& simulation, double duration);

}  // namespace pliant::tool
