// The tables of a mesh for packs, made from its hierarchy: see backend/host/mesh_lanes.hpp.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "backend/host/mesh_lanes.hpp"
#include "backend/host/planes.hpp"
#include "backend/host/solver_state.hpp"
#include "body/hierarchy.hpp"

namespace pliant::cpu {

class MeshTables {
public:
    /// Empty for a sheet, and for the paper's solver. Writes the empty blocks into `solver`.
    MeshTables(const Hierarchy& hierarchy, SolverState<float>& solver);

    bool empty() const { return levels_.empty(); }
    /// The number of groups of nodes whose records a call needs.
    std::size_t record_groups(const Call& call) const;

private:
    struct Entry {
        std::int32_t place = 0;
        float weight = 0;
        std::int32_t edge = 0;
    };
    using Row = std::vector<Entry>;
    struct Table {
        LaneTable lanes;
        const std::int32_t* edges = nullptr;
    };
    /// row_of(k) appends the entries of row k; filler(k) is the entry that pads its lane.
    Table make_table(std::int32_t count, const std::function<void(std::int32_t, Row&)>& row_of,
                     const std::function<Entry(std::int32_t)>& filler);
    /// Calls function(first, second) for the pairs of a row of the hierarchy's topology.
    template <class Function>
    void for_each_pair(std::int32_t start, std::int32_t row, const Function& function) const;

    void add_nodes(MeshLanes& lanes, const SolverLevel& level);
    void add_springs(MeshLanes& lanes, const SolverLevel& level);
    void add_transfers(MeshLanes& lanes, const SolverLevel& level, const SolverLevel& finer);
    LaneTable weighted(std::int32_t count, std::int32_t start, const std::vector<std::int32_t>& order,
                       std::int32_t offset, std::int32_t factor, std::int32_t filler);

    const std::int32_t* keep(std::vector<std::int32_t> integers);
    float* keep(std::vector<float> numbers);

    const Hierarchy* hierarchy_;
    std::vector<MeshLanes> levels_;
    std::deque<std::vector<std::int32_t>> integers_;
    std::deque<AlignedArray<float>> numbers_;
};

}  // namespace pliant::cpu
