// The data of a pass of the constraint solver on the host: where its numbers are.
#pragma once

#include <cstddef>

#include "backend/host/mesh_lanes.hpp"
#include "body/hierarchy.hpp"
#include "laws/laws.hpp"
#include "solve/pass.hpp"
#include "solve/solver_constants.hpp"

namespace pliant {

/// Where the flags of a pass's live rows begin in a solve of ACAD.
inline std::int32_t live_flags(Pass pass, const SolverLevel& level, const SolverLevel& finer)
{
    const PassUnit unit = unit_of(pass);
    return unit == PassUnit::live_edge         ? level.live_edges
           : unit == PassUnit::live_finer_node ? finer.live
                                               : level.live;
}

template <class Number>
struct NumberPlanes {
    Number *x = nullptr, *y = nullptr, *z = nullptr;
};

template <class Number>
struct SolverContext {
    Number* arena = nullptr;
    const SolverLevel* levels = nullptr;
    const std::int32_t* topology = nullptr;
    Number* scalars = nullptr;
    Number* parts = nullptr;  ///< sums of groups, a row per slot
    int part_stride = 0;
    const int* part_counts = nullptr;  ///< by slot
    int bottom_base = 0;
    NumberPlanes<Number> position, velocity, next_position, next_velocity, external_force;
    Number* multiplier = nullptr;
    const Number *inverse_mass = nullptr, *mass = nullptr;
    const SolverConstants<Number>* constants = nullptr;
    const typename Laws<Number>::Collider* colliders = nullptr;
    int collider_count = 0;
    const MeshLanes* lanes = nullptr;  ///< by level; for meshes that run in packs
};

}  // namespace pliant
