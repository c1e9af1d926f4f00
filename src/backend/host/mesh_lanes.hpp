// What kernels of packs need of a mesh: its tables by slices of 16 lanes, so that neighbouring nodes are
// worked on side by side, and copies of numbers that are found in one place. Made in backend/cpu.
#pragma once

#include <cstdint>

#include "solve/pass.hpp"

namespace pliant {

/// Rows of 16 lanes: the k-th entry of each of 16 neighbouring nodes or edges. Slice s begins with row
/// start[s]. A lane that has fewer entries than others is filled with ones that change nothing.
struct LaneTable {
    static constexpr int lanes = 16, counted = 4;
    const std::int32_t* start = nullptr;
    const std::int32_t* rows = nullptr;   ///< how many, for each 4 lanes
    const std::int32_t* place = nullptr;  ///< by entry
    const float* weight = nullptr;        ///< by entry
};

/// A level of a mesh.
struct MeshLanes {
    /// Floats of a vector in a record, and of the displacement of a node and where it started.
    static constexpr int vector_size = 4, state_size = 8;
    /// Of nodes. Places are of records, in floats; a filled entry is the node itself, without a coupling. The
    /// weight is 1 at an edge's first node and -1 at its second.
    LaneTable neighbours;
    const std::int32_t* neighbour_edges = nullptr;  ///< by entry: twice the edge's number
    float* couplings = nullptr;                     ///< by row: 6 numbers of 16 lanes, N/m
    LaneTable held, loose;     ///< of the cloth: places are twice edges, weights as above
    float* vectors = nullptr;  ///< records of a vector that neighbours are asked for
    float* states = nullptr;   ///< of the cloth: the same
    // Of edges of the cloth: records of their ends, in floats, and the class of springs.
    const std::int32_t *first_end = nullptr, *second_end = nullptr;
    const float* spring_class = nullptr;
    const std::int32_t* class_of_group = nullptr;  ///< of sum_columns edges; -1: of several classes
    int classes[3]{}, class_count = 0;             ///< that there are
    // How this level comes from the finer one, by weights. A filled entry has the weight -0 and the number 0.
    LaneTable parents;   ///< of nodes of the finer one; places are of records, in floats
    LaneTable children;  ///< of nodes; places are nodes of the finer one
    /// Of edges, in an order of their own, source_edges; places are twice blocks of the finer one.
    LaneTable sources;
    const std::int32_t* source_edges = nullptr;
    LaneTable
        folds;  ///< of edges of the cloth, what is folded onto them; places are twice blocks of the level
};

/// Passes of meshes that find their neighbours in records, which must be made before.
constexpr bool asks_for_records(Pass pass)
{
    return host_loop_of(pass) == HostLoop::records || host_loop_of(pass) == HostLoop::record_groups;
}
/// Passes of meshes that packs run.
constexpr bool has_lanes(Pass pass)
{
    return asks_for_records(pass) || host_loop_of(pass) == HostLoop::lanes ||
           host_loop_of(pass) == HostLoop::groups;
}

}  // namespace pliant
