// How a mesh becomes coarser for the constraint solver: smoothed aggregation on its graph.
// Source: Vanek, Mandel, Brezina, "Algebraic multigrid by smoothed aggregation for second and fourth order
// elliptic problems", Computing 56, 1996.
#pragma once

#include <cstdint>
#include <vector>

#include "body/cloth_model.hpp"

namespace pliant {

/// A level of a mesh: its nodes that move, and what couples them.
struct MeshGraph {
    struct Coupling {
        std::uint32_t i = 0, j = 0;  ///< i < j
        double weight = 0;           ///< how stiff; a coarse level may have negative ones
    };
    std::uint32_t node_count = 0;
    std::vector<Coupling> couplings;  ///< sorted by (i, j), which may come several times
};

/// A number of the finer level, and how much of it goes into one of the coarse level.
struct WeightedSource {
    std::uint32_t source = 0;
    float weight = 0;
};

/// A coarse level, and what its numbers are sums of. "Blocks" of a level are its couplings and then the row
/// sums of its nodes, numbered through.
struct CoarseMesh {
    MeshGraph graph;
    /// By fine node: coarse nodes and how much it takes of them. The weights of a node that is coupled to
    /// others sum up to 1; a node on its own takes nothing, since smoothing solves it.
    Ragged<WeightedSource> parents;
    Ragged<WeightedSource> children;   ///< by coarse node: fine nodes, the same weights
    Ragged<WeightedSource> couplings;  ///< by coarse coupling: blocks of the finer level
};

CoarseMesh coarser(const MeshGraph& fine);

}  // namespace pliant
