// Which springs of a cloth a constraint holds, from the results of its solver in the last step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "backend/pass_runner.hpp"
#include "pliant/simulation.hpp"

namespace pliant {

/// Springs in the order of Simulation::springs. Reuses the memory of its buffers.
class HeldSprings {
public:
    /// `springs`: from Simulation::springs. `node_of_vertex`: empty if nodes are in the order of the
    /// vertices.
    HeldSprings(const ClothModel& model, std::span<const SpringListing> springs,
                std::span<const std::uint32_t> node_of_vertex);

    /// Writes 1 for each spring that a constraint holds. `positions`, m, and `forces`, the largest constraint
    /// force, N, are by vertex. A spring is held if:
    /// - acad: the solver marked it as a limit, and it is beyond that limit (as for constraint where steps
    ///   are too long for springs alone);
    /// - the paper's solver: it has a row of the system;
    /// - constraint: its limit remembers a force;
    /// - constraint with a penalty: it is beyond its limit, and constraint forces act on both its nodes.
    void read(PassRunner& runner, std::uint32_t model, std::span<const Vec3> positions,
              std::span<const float> forces, std::vector<std::uint32_t>& held);

private:
    struct Row {
        std::uint32_t i = 0, j = 0;  ///< vertices
        float least = -1;            ///< m, length from which it can be held; below 0: never
        std::int64_t mark = -1;      ///< index of its mark, or slip, in `marks_`; -1: none
        bool remembers = false;      ///< its limit remembers its force
    };
    void find_sheet_marks(const ClothModel& model);
    void find_listed_marks(const ClothModel& model, std::span<const std::uint32_t> node_of_vertex,
                           const std::int32_t* ends, std::size_t stride);

    bool marked_ = false;     ///< the solver marks springs
    bool rows_ = false;       ///< the paper's solver
    bool remembers_ = false;  ///< marks_ has the slips of limits with memory
    std::size_t first_ = 0, count_ = 0;
    std::vector<Row> springs_;
    std::vector<float> marks_;
};

}  // namespace pliant
