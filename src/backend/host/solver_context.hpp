// What a pass of the constraint solver is given on the host: where its numbers lie, and the constants of the
// step.
#pragma once

#include <cstddef>

#include "backend/host/mesh_lanes.hpp"
#include "body/hierarchy.hpp"
#include "laws/laws.hpp"
#include "solve/pass.hpp"

namespace pliant {

template <class Number>
struct SolverConstants {
    /// As LimitCurve of laws/limit.law.glsl.
    struct Curve {
        int kind = 0;
        Number below{}, limit{}, beyond{}, compressed{}, damping{}, reach{}, kept{};
    };
    Number dt{}, inverse_dt{}, decay{}, thickness{};
    // Steps of second order: see newton.kernel.glsl. 0: they are of first order.
    int history_plane = 0;
    Number short_dt{}, inverse_short_dt{}, third{}, air{};  ///< s, 1/s, 1/3, 1/s
    Vector3<Number> gravity{};
    Curve curves[3]{};  ///< by class
    bool has[3]{};      ///< classes that are not off
    bool has_damping = false;
    bool is_graded = false;    ///< springs of a mesh have numbers of their own
    bool exact_bend = false;   ///< bend springs are stiff: the operator has them as they are, not folded
    Number rest_lengths[5]{};  ///< m, of a sheet
    bool contact_is_by_mass = false;
    Number contact_stiffness{};  ///< N/m; by mass: of m / dt^2
    Number slip{};               ///< m
    // ACAD, by length squared over rest length squared: see kernels/acad.kernel.glsl.
    bool is_acad = false, acad_has_memory = false;
    Number acad_reach{};  ///< how far a correction may take springs, of what is beyond the threshold
    Number acad_above2{}, acad_below2{}, acad_held_above2{}, acad_held_below2{}, acad_near_above2{},
        acad_near_below2{};
    int held = -1;  ///< offset of the node in a hand, see GrabInput
    Vector3<Number> hand_target{};
    Number hand_pull{}, hand_hold{};
    Number linear_tolerance{}, newton_tolerance{}, enough_iterations{};
    // Limits that remember: which classes have them, and numbers of renewed_limit in laws/limit.law.glsl.
    bool remembers[3]{};
    Number softest[3]{}, compliance[3]{};      ///< N/m, with the compliance; m/N
    Number softest_limit{}, stiffest_limit{};  ///< N/m, without it
    Number polish_reach{};                     ///< m
    /// N/m, of a mesh's springs that hold a node: with the compliance, and without it.
    Number softest_held{}, softest_held_limit{};
    static constexpr int most_relaxations = 8;
    Number relaxations[most_relaxations]{};
};

/// Where the flags of a pass's rows begin that take part in a solve of ACAD.
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
    Number* parts = nullptr;  ///< sums of groups, a row for each slot
    int part_stride = 0;
    const int* part_counts = nullptr;  ///< by slot
    int bottom_base = 0;
    NumberPlanes<Number> position, velocity, next_position, next_velocity, external_force;
    Number* multiplier = nullptr;
    const Number *inverse_mass = nullptr, *mass = nullptr;
    const SolverConstants<Number>* constants = nullptr;
    const typename Laws<Number>::Collider* colliders = nullptr;
    int collider_count = 0;
    const MeshLanes* lanes = nullptr;  ///< by level; of meshes where packs run them
};

}  // namespace pliant
