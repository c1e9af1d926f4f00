// Passes and programs: what the methods are written in, and what the backends run.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "kernels/planes.hpp"

namespace pliant {

enum class Pass : std::uint32_t {
#define PASS(name, ...) name,
#include "solve/passes.def"
#undef PASS
};

/// What passes read and write. State comes in two copies; a call's `parity` says which one is current.
enum class Resource : std::uint32_t {
    position,        ///< 3 floats per node, m
    velocity,        ///< 3 floats per node, m/s
    next_position,   ///< the other copy of position
    next_velocity,   ///< the other copy of velocity
    external_force,  ///< 3 floats per node, N
    spring_force,    ///< 3 floats per spring, N, on its node i
    colliders,       ///< one row per collider and step of the frame
    measures,        ///< 8 floats per block of 256, levels of a tree one after the other
    normal,          ///< 3 floats per node
    strain,          ///< 1 float per node
    slopes,      ///< 6 floats per node: changes of position and velocity, summed over the stages of a step
    multiplier,  ///< 1 float per node, N: the largest force of a constraint at it
    gradient,    ///< 3 floats per node of a body, m2: 6 dV/dx
    direction,   ///< 3 floats per node of a body: how the volume constraint moves it
    blocked,     ///< 4 floats per node of a body: the normal of what held it, and how many did
    rate_sums,   ///< 8 floats per block of nodes, see VolumeRate of laws/volume.law.glsl
    cubic_sums,  ///< 8 floats per block of fans, see VolumeCubic
    bodies,      ///< 4 floats per body: its centre, m, and 6 V, m3
    volumes,     ///< 1 float per body, m3: 6 V as it was measured last
    solver,      ///< the arena of numbers of the constraint solver, and its scalars
};

enum class PassSize { node, spring, block, level, cell, single, row, scan, edge, finer, live, fan, body };

struct PassDescription {
    const char* name;
    PassSize size;
    std::span<const Resource> reads, writes;
};
const PassDescription& description_of(Pass pass);
std::span<const PassDescription> all_passes();

/// A call is skipped while the scalar that guards it is set: its loop has ended.
enum class Guard : std::uint32_t {
    newton = scalar_newton_done,
    linear = scalar_linear_done,
    search = scalar_search_done,
    idle = scalar_idle,
    none = scalar_count,
};

/// One run of a pass over one cloth.
struct Call {
    Pass pass;
    std::uint32_t cloth = 0;
    std::uint32_t parity = 0;  ///< which copy of the state is current: 0 or 1
    std::uint32_t index = 0;   ///< the step of the frame (for its colliders); of measure_merge, the level
    // Of the constraint solver's passes:
    std::uint32_t level = 0;   ///< of the hierarchy, 0 being the cloth
    std::uint32_t detail = 0;  ///< see `detail_of`; of stage_step, the stage (laws/integration.law.glsl)
    Guard guard = Guard::none;
    std::uint32_t guarded_after =
        0;  ///< calls right after this one that are skipped when it is, see append_frame
};

/// The planes and the weight of a smoothing step: it reads copy `source` (0 or 1) of the correction, and
/// damps by number `relaxation` of SolverConstants::relaxations.
constexpr std::uint32_t detail_of(std::uint32_t source, std::uint32_t relaxation)
{
    return source | relaxation << 1;
}

/// A detail of sheet_gather: the last look of a step, for the energy alone.
constexpr std::uint32_t last_look = 1;
/// One that a polish follows: forces and diagonals are asked for, and no couplings.
constexpr std::uint32_t polish_look = 2;

/// Sums that a pass leaves in parts.
struct SumSlots {
    std::uint32_t first = 0, count = 0;
};
SumSlots sum_slots_of(Pass pass);

constexpr std::uint32_t sum_slot_count = sum_slots;

/// Sums are taken by one tree, whatever runs a pass: over groups of sum_columns columns (or edges, or rows)
/// by halves, which leaves the parts; then over the parts, every 256th in a lane, and the lanes by halves.
constexpr int sum_lanes = 256;
constexpr int most_sums = 3;  ///< of one pass
constexpr std::uint32_t solver_scalar_count = scalar_count;

/// Neighbouring numbers of the arena of a cloth's solver (Hierarchy).
struct ArenaRange {
    std::size_t first = 0, count = 0;
};

/// What is kept aside of a cloth before a program, so that its steps can be taken anew
/// (PassRunner::put_back): numbers of its solver's arena, the solver's scalars, and a copy of the state.
struct Kept {
    std::uint32_t cloth = 0;
    std::uint32_t parity = 0;
    bool state = true;  ///< false where the program leaves that copy of the state as it is
    std::vector<ArenaRange> numbers = {};
};

/// A sequence of calls with an identity, so that a backend can record it once and replay it.
struct Program {
    std::uint64_t id = 0;  ///< unique among the programs given to one runner
    std::vector<Call> calls;
    std::uint32_t parity_after = 0;  ///< the current copy of the state when it is done
    std::vector<Kept> keeps = {};    ///< before the first call
};

/// Passes of soft bodies alone.
constexpr bool is_body_pass(Pass pass) { return pass >= Pass::load_force && pass <= Pass::volume_total; }
/// Passes of the constraint solver: they work on its arena and share its kernels.
constexpr bool is_solver_pass(Pass pass) { return pass >= Pass::solve_reset; }
/// Those of the solver paper, which are over nodes and springs and not over packs of them.
constexpr bool is_paper_pass(Pass pass) { return pass >= Pass::paper_begin && pass <= Pass::paper_end; }

/// Those that go by the neighbours on a mesh.
constexpr bool is_mesh_pass(Pass pass) { return pass >= Pass::mesh_springs && pass <= Pass::mesh_prolong; }

/// Those that ACAD's solve makes over rows (groups of a mesh) that have a marked spring, and no others.
bool is_of_live_rows(Pass pass);

/// Values of one block of a reduction.
constexpr std::uint32_t block_size = 256;

/// How the levels of a tree of measures lie one after the other: level 0 has a value per block of nodes.
struct MeasureTree {
    explicit MeasureTree(std::uint32_t node_count);
    struct Level {
        std::uint32_t first = 0, count = 0;
    };
    std::vector<Level> levels;  ///< the last has one value: the result
    std::uint32_t value_count = 0;
};

}  // namespace pliant
