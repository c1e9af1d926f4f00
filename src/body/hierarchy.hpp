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

/// One level in the solver's arena of numbers, as kernels and shaders read it (shaders/solver.glsl has the
/// same). Plane p of a level holds the number of the node at (row, column) at base + p size + offset(row,
/// column).
struct SolverLevel {
    std::int32_t rows = 0, columns = 0;
    std::int32_t stride = 0;  ///< numbers from a row to the next
    std::int32_t base = 0;    ///< of plane 0
    std::int32_t size = 0;    ///< numbers of a plane
    // Of a mesh's level only. Edges are what couples nodes: on the cloth its springs. Those between free
    // nodes come first, then those that hold one to a pinned node, then loose ones: bend springs that are
    // folded.
    std::int32_t edges = 0;
    std::int32_t edge_base = 0;  ///< of plane 0 of the edges; k numbers of edge e from plane p on are at
    std::int32_t edge_size = 0;  ///< edge_base + p edge_size + k e
    // Places in `topology`; "start" is where a row begins for each node or edge, and one more.
    std::int32_t edge_ends = 0;   ///< offset, offset, class of springs for each edge
    std::int32_t row_start = 0;   ///< of nodes: pairs (offset of the neighbour, edge)
    std::int32_t held_start = 0;  ///< of the cloth's nodes: the same for pinned neighbours
    // How this level comes from the finer one: pairs (source, weight), the weight being the bits of a float.
    std::int32_t parents_start = 0;   ///< of the finer level's nodes; sources are offsets on this one
    std::int32_t children_start = 0;  ///< of nodes; sources are offsets on the finer one
    std::int32_t loose_start = 0;     ///< of the cloth's nodes: as row_start, of loose springs
    std::int32_t coupling_start = 0;  ///< of edges; sources are blocks of the finer one, see mesh.kernel.glsl
    // Of ACAD: where in the arena the flags of rows begin that take part in a solve
    // (kernels/acad.kernel.glsl); on a mesh, of groups of nodes and of edges.
    std::int32_t live = 0, live_edges = 0;
    // Of the cloth: the first edge that holds a node, and the first that is loose. Those before have a row
    // each of blocks that make theirs, by weights.
    std::int32_t held = 0, loose = 0, fold_start = 0;
    std::int32_t reserved[2]{};

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
