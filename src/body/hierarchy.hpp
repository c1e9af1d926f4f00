// The levels of one cloth's constraint solver, made once from the cloth's topology and pins. Operators are
// recomputed at every Newton step; this defines where their numbers are stored.
#pragma once

#include <cstdint>
#include <vector>

#include "body/constraint_rows.hpp"
#include "body/node_layout.hpp"
#include "kernels/planes.hpp"

namespace pliant {

class ClothModel;

#include "kernels/level.glsl"

/// One level in the solver's arena. Plane p stores the number of the node at (row, column) at base + p size +
/// offset(row, column).
struct SolverLevel : LevelNumbers {
    SolverLevel() : LevelNumbers{} {}

    /// Where plane 0 begins, relative to `base`. A sheet's plane includes its border; a mesh's has one row
    /// and no border.
    std::int32_t first_of_plane() const
    {
        return edge_size > 0 ? static_cast<std::int32_t>(NodeLayout::border_rows) * stride : 0;
    }
    bool folds() const { return loose < edges; }
    /// Units into which passes over nodes are divided: rows of a sheet, groups of a mesh.
    std::int32_t node_units() const { return rows > 1 ? rows : sum_groups(columns); }
};

class Hierarchy {
public:
    /// Empty, for a cloth without a solver.
    Hierarchy() = default;
    explicit Hierarchy(const ClothModel& cloth);

    bool empty() const { return levels.empty(); }
    std::size_t level_count() const { return levels.size(); }
    /// Offset of the node at (row, column) within a plane, as in NodeLayout.
    static std::int32_t offset(const SolverLevel& level, std::int32_t row, std::int32_t column);

    std::vector<SolverLevel> levels;      ///< finest first
    std::vector<std::int32_t> topology;   ///< of a mesh
    std::vector<double> rest_lengths;     ///< m, of the edges of a mesh
    std::vector<double> scales, bending;  ///< of graded springs, see Spring
    std::size_t number_count = 0;         ///< of the arena
    std::int32_t history_plane = 0;       ///< of the cloth: where history_planes begin; 0: none
    std::int32_t bottom_base = 0;         ///< offset of the dense operator of the coarsest level
    ConstraintRows constraints;           ///< the paper's solver, which has only the cloth's level

private:
    void build_sheet(const ClothModel& cloth);
    void build_mesh(const ClothModel& cloth);  // mesh_hierarchy.cpp
    void build_rows(const ClothModel& cloth);
    void append_live_flags();
    SolverLevel append_level(std::int32_t rows, std::int32_t columns, std::int32_t planes);
    SolverLevel& append_mesh_level(std::int32_t nodes, std::int32_t edges, std::int32_t node_planes_count,
                                   std::int32_t edge_planes_count);
};

}  // namespace pliant
