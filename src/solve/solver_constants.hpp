// Constants of the constraint solver in the numbers of a kernel, and what its arena holds before the first
// step.
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

/// Constants of a step in the numbers of a kernel. `grab` is of this cloth, or nothing.
template <class T>
SolverConstants<T> make_solver_constants(const ClothModel& model, double step_length,
                                         const GrabInput& grab = {});

/// What an arena of zeros holds before the first step: the numbers that come from the topology alone.
template <class T>
void set_first_numbers(const ClothModel& model, const Hierarchy& hierarchy, T* arena);

/// The parts that the sums of a cloth's solver are left in, by slot.
struct SumParts {
    SumParts() = default;
    SumParts(const ClothModel& model, const Hierarchy& hierarchy);  ///< of a hierarchy that is not empty

    std::array<int, sum_slot_count> counts{};
    int stride = 0;  ///< the largest of them
};

}  // namespace pliant
