// The levels on which the constraint solver works on one cloth: made once, from the cloth's topology and pins
// alone. The numbers of the operators are refreshed at every Newton step; where they lie is said here.
#pragma once

#include <cstdint>
#include <vector>

#include "body/constraint_rows.hpp"
#include "body/node_layout.hpp"
#include "kernels/planes.hpp"

namespace pliant {

class ClothModel;

#include "kernels/level.glsl"

/// One level in the solver's arena of numbers. Plane p of a level holds the number of the node at (row,
/// column) at base + p size + offset(row, column).
struct SolverLevel : LevelNumbers {
    SolverLevel() : LevelNumbers{} {}

    /// Where plane 0 begins, against `base`: with the border of a sheet; of a mesh, which has one row and no
    /// border, with that row.
    std::int32_t first_of_plane() const
    {
        return edge_size > 0 ? static_cast<std::int32_t>(NodeLayout::border_rows) * stride : 0;
    }
    bool folds() const { return loose < edges; }
    /// What passes over nodes are divided into: rows of a sheet, and of a mesh, which has but one, groups.
    std::int32_t node_units() const { return rows > 1 ? rows : sum_groups(columns); }
};

class Hierarchy {
public:
    /// Empty for a cloth that needs no solver.
    Hierarchy() = default;
    explicit Hierarchy(const ClothModel& cloth);

    bool empty() const { return levels.empty(); }
    std::size_t level_count() const { return levels.size(); }
    /// Where in a plane the node at (row, column) is: as NodeLayout.
    static std::int32_t offset(const SolverLevel& level, std::int32_t row, std::int32_t column);

    std::vector<SolverLevel> levels;      ///< finest first
    std::vector<std::int32_t> topology;   ///< of a mesh
    std::vector<double> rest_lengths;     ///< m, of the edges of a mesh
    std::vector<double> scales, bending;  ///< of graded springs, as Spring has them
    std::size_t number_count = 0;         ///< of the arena
    std::int32_t history_plane = 0;       ///< of the cloth: where history_planes begin; 0: there are none
    std::int32_t bottom_base = 0;         ///< where the dense operator of the last level lies
    ConstraintRows constraints;           ///< of the solver paper, which has no levels but the cloth

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
