// Tables of a mesh for kernels of packs: in slices of 16 lanes, so that neighbouring nodes are processed
// together, and copies of numbers in one place. Made in backend/cpu.
#pragma once

#include <cstdint>

#include "solve/pass.hpp"

namespace pliant {

/// Rows of 16 lanes: the k-th entries of 16 neighbouring nodes or edges. Slice s begins with row start[s].
/// Lanes with fewer entries are padded with neutral ones.
struct LaneTable {
    static constexpr int lanes = 16, counted = 4;
    const std::int32_t* start = nullptr;
    const std::int32_t* rows = nullptr;   ///< number of rows, for every 4 lanes
    const std::int32_t* place = nullptr;  ///< by entry
    const float* weight = nullptr;        ///< by entry
};

/// A level of a mesh.
struct MeshLanes {
    /// Floats of a vector in a record; floats of a node's displacement and start.
    static constexpr int vector_size = 4, state_size = 8;
    /// Of nodes. Places are offsets of records, in floats; padding refers to the node itself, without a
    /// coupling. The weight is 1 at an edge's first node and -1 at its second.
    LaneTable neighbours;
    const std::int32_t* neighbour_edges = nullptr;  ///< by entry: twice the edge's number
    float* couplings = nullptr;                     ///< by row: 6 numbers of 16 lanes, N/m
    LaneTable held, loose;     ///< of the cloth's level: places are twice edges, weights as above
    float* vectors = nullptr;  ///< records of the vector that neighbours read
    float* states = nullptr;   ///< of the cloth's level: the same
    // Edges of the cloth's level: records of their ends, in floats, and their classes of springs.
    const std::int32_t *first_end = nullptr, *second_end = nullptr;
    const float* spring_class = nullptr;
    const std::int32_t* class_of_group = nullptr;  ///< by group of sum_columns edges; -1: several classes
    int classes[3]{}, class_count = 0;             ///< the classes that occur
    // Interpolation with the finer level, by weights. Padding has the weight -0 and the number 0.
    LaneTable parents;   ///< of nodes of the finer level; places are of records, in floats
    LaneTable children;  ///< of nodes; places are nodes of the finer level
    /// Of edges, in the order source_edges; places are twice blocks of the finer level.
    LaneTable sources;
    const std::int32_t* source_edges = nullptr;
    LaneTable folds;  ///< of edges of the cloth's level: springs folded onto them; places are twice blocks of
                      ///< this level
};

/// Passes of meshes that read neighbours from records, which must be made first.
constexpr bool asks_for_records(Pass pass)
{
    return host_loop_of(pass) == HostLoop::records || host_loop_of(pass) == HostLoop::record_groups;
}
/// Passes of meshes that run in packs.
constexpr bool has_lanes(Pass pass)
{
    return asks_for_records(pass) || host_loop_of(pass) == HostLoop::lanes ||
           host_loop_of(pass) == HostLoop::groups;
}

}  // namespace pliant
