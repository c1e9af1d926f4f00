// Constants of the constraint solver in a kernel's number type, and the initial contents of its arena.
#pragma once

#include <array>

#include "body/hierarchy.hpp"
#include "solve/pass.hpp"
#include "solve/step_constants.hpp"

namespace pliant {

template <class Number>
struct SolverConstants {
    /// As LimitCurve of laws/limit.law.glsl.
    struct Curve {
        int kind = 0;
        Number below{}, limit{}, beyond{}, compressed{}, damping{}, reach{}, kept{};
    };
    Number dt{}, inverse_dt{}, decay{}, thickness{};
    // Second-order steps: see newton.kernel.glsl. 0: first order.
    int history_plane = 0;
    Number short_dt{}, inverse_short_dt{}, third{}, air{};  ///< s, 1/s, 1/3, 1/s
    Vector3<Number> gravity{};
    Curve curves[3]{};  ///< by class
    bool has[3]{};      ///< classes that are not off
    bool has_damping = false;
    bool is_graded = false;    ///< springs of a mesh have individual parameters
    bool exact_bend = false;   ///< bend springs are stiff: the operator has them exactly, not folded
    Number rest_lengths[5]{};  ///< m, of a sheet
    bool contact_is_by_mass = false;
    Number contact_stiffness{};  ///< N/m; factor on m / dt^2
    Number slip{};               ///< m
    // ACAD, by squared length over squared rest length: see kernels/acad.kernel.glsl.
    bool is_acad = false, acad_has_memory = false;
    Number acad_reach{};  ///< how far a correction may take springs, relative to the excess over the
                          ///< threshold
    Number acad_above2{}, acad_below2{}, acad_held_above2{}, acad_held_below2{}, acad_near_above2{},
        acad_near_below2{};
    int held = -1;  ///< offset of the hand's node, see GrabInput; -1: none
    Vector3<Number> hand_target{};
    Number hand_pull{}, hand_hold{};
    Number linear_tolerance{}, newton_tolerance{}, enough_iterations{};
    // Limits with memory: which classes have them, and the parameters of renewed_limit in
    // laws/limit.law.glsl.
    bool remembers[3]{};
    Number softest[3]{}, compliance[3]{};      ///< N/m, with the compliance; m/N
    Number softest_limit{}, stiffest_limit{};  ///< N/m, without compliance
    Number polish_reach{};                     ///< m
    /// N/m, for a mesh's springs to pinned nodes: with the compliance, and without.
    Number softest_held{}, softest_held_limit{};
    static constexpr int most_relaxations = 8;
    Number relaxations[most_relaxations]{};
};

/// Constants of a step in a kernel's number type. `grab` is for this cloth, or empty.
template <class T>
SolverConstants<T> make_solver_constants(const ClothModel& model, double step_length,
                                         const GrabInput& grab = {});

/// The initial contents of an arena of zeros: the numbers that follow from the topology alone.
template <class T>
void set_first_numbers(const ClothModel& model, const Hierarchy& hierarchy, T* arena);

/// The number of parts of each sum of a cloth's solver, by slot.
struct SumParts {
    SumParts() = default;
    SumParts(const ClothModel& model, const Hierarchy& hierarchy);  ///< for a hierarchy that is not empty

    std::array<int, sum_slot_count> counts{};
    int stride = 0;  ///< the largest number of parts
};

}  // namespace pliant
