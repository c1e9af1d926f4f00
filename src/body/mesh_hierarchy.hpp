// Coarsening of a mesh for the constraint solver: smoothed aggregation on its graph. Source: Vanek, Mandel,
// Brezina, "Algebraic multigrid by smoothed aggregation for second and fourth order elliptic problems",
// Computing 56, 1996.
#pragma once

#include <cstdint>
#include <vector>

#include "body/cloth_model.hpp"

namespace pliant {

/// The graph of a level: its free nodes and their couplings.
struct MeshGraph {
    struct Coupling {
        std::uint32_t i = 0, j = 0;  ///< i < j
        double weight = 0;           ///< stiffness; may be negative on a coarse level
    };
    std::uint32_t node_count = 0;
    std::vector<Coupling> couplings;  ///< sorted by (i, j); a pair may occur several times
};

/// A number of the finer level, and its weight in a number of the coarse level.
struct WeightedSource {
    std::uint32_t source = 0;
    float weight = 0;
};

/// A coarse level, and the sums that give its numbers. The "blocks" of a level are its couplings followed by
/// the row sums of its nodes.
struct CoarseMesh {
    MeshGraph graph;
    /// By fine node: coarse nodes and their weights. The weights of a coupled node sum to 1; an isolated node
    /// has none, since smoothing solves it.
    Ragged<WeightedSource> parents;
    Ragged<WeightedSource> children;   ///< by coarse node: fine nodes, the same weights
    Ragged<WeightedSource> couplings;  ///< by coarse coupling: blocks of the finer level
};

CoarseMesh coarser(const MeshGraph& fine);

}  // namespace pliant
