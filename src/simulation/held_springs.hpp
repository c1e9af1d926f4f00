// Which springs of a cloth a constraint holds, by what its solver has decided in the last step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "backend/pass_runner.hpp"
#include "pliant/simulation.hpp"

namespace pliant {

/// Springs in the order of Simulation::springs. What it reads into keeps its memory.
class HeldSprings {
public:
    /// `springs`: as Simulation::springs has them. `node_of_vertex`: empty where they are the same.
    HeldSprings(const ClothModel& model, std::span<const SpringListing> springs,
                std::span<const std::uint32_t> node_of_vertex);

    /// 1 for each spring that is held. `positions`, m, and `forces`, the largest of a constraint, N, are by
    /// vertex. A spring is held by
    /// - acad: when the solver marked it as a limit, and it is beyond that (as constraint where steps are too
    ///   long for springs alone);
    /// - the paper's solver: when it has a row of the system;
    /// - constraint: when its limit remembers a force;
    /// - constraint by a penalty: when it is beyond its limit, and both its nodes feel a force.
    void read(PassRunner& runner, std::uint32_t model, std::span<const Vec3> positions,
              std::span<const float> forces, std::vector<std::uint32_t>& held);

private:
    struct Row {
        std::uint32_t i = 0, j = 0;  ///< vertices
        float least = -1;            ///< m, length from which it can be held; below 0: never
        std::int64_t mark = -1;      ///< place of its mark, or slip, among `marks_`, when it has one
        bool remembers = false;      ///< its limit remembers its force
    };
    void find_sheet_marks(const ClothModel& model);
    void find_listed_marks(const ClothModel& model, std::span<const std::uint32_t> node_of_vertex,
                           const std::int32_t* ends, std::size_t stride);

    bool marked_ = false;     ///< the solver marks springs
    bool rows_ = false;       ///< it is the paper's
    bool remembers_ = false;  ///< what is read are slips of limits that remember
    std::size_t first_ = 0, count_ = 0;
    std::vector<Row> springs_;
    std::vector<float> marks_;
};

}  // namespace pliant
