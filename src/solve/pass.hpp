// Passes and programs: the sequences of operations that backends run.
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
};

/// The subject of a pass.
enum class PassFamily {
    cloth,   ///< explicit steps of cloths, measures, what is drawn
    body,    ///< soft bodies
    solver,  ///< newton_multigrid, of every cloth
    sheet,   ///< newton_multigrid, of sheets
    mesh,    ///< newton_multigrid, of meshes
    paper,   ///< the solver of the cloth paper
};

/// What one invocation of a pass works on.
enum class PassUnit : std::uint32_t {
#define UNIT(name, ...) name,
#include "solve/passes.def"
};
const char* description_of(PassUnit unit);
constexpr bool is_live(PassUnit unit)
{
    using enum PassUnit;
    return unit == live_node || unit == live_edge || unit == live_cell || unit == live_finer_cell ||
           unit == live_finer_node;
}

/// How the host runs a pass of a solver.
enum class HostLoop {
    each,           ///< unit by unit: in packs on sheets, one at a time on meshes
    own_rows,       ///< by its own loop NAME_rows (backend/host)
    lanes,          ///< meshes: in packs, by NAME_lanes (backend/host/mesh_rows.inl)
    records,        ///< the same; reads neighbours from records, which are made first
    groups,         ///< meshes: in packs, by its own loop NAME_groups
    record_groups,  ///< the same, from records
};

/// What passes read and write.
enum class Resource : std::uint32_t {
#define RESOURCE(name, ...) name,
#include "solve/passes.def"
};
const char* name_of(Resource resource);
const char* description_of(Resource resource);

/// Sums that a pass stores in parts.
struct SumSlots {
    std::uint32_t first = 0, count = 0;
};

struct PassDescription {
    const char* name;
    PassFamily family;
    PassUnit unit;
    std::span<const Resource> reads, writes;  ///< of an unguarded call, including sums and flags
    SumSlots sums;
};
const PassDescription& description_of(Pass pass);
std::span<const PassDescription> all_passes();

/// A call is skipped while its guard's scalar is set, which says that its loop has ended.
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
    std::uint32_t index = 0;   ///< the step of the frame (for colliders); for measure_merge, the level of the
                               ///< tree
    // Of the constraint solver's passes:
    std::uint32_t level = 0;   ///< of the hierarchy, 0 being the cloth
    std::uint32_t detail = 0;  ///< see `detail_of`; of stage_step, the stage (laws/integration.law.glsl)
    Guard guard = Guard::none;
    std::uint32_t guarded_after =
        0;  ///< number of calls right after this one that are skipped with it, see append_frame
};

/// The detail of a smoothing step: it reads copy `source` (0 or 1) of the correction, and damps by number
/// `relaxation` of SolverConstants::relaxations.
constexpr std::uint32_t detail_of(std::uint32_t source, std::uint32_t relaxation)
{
    return source | relaxation << 1;
}

SumSlots sum_slots_of(Pass pass);

constexpr std::uint32_t sum_slot_count = sum_slots;

/// All backends take sums in the same tree: over groups of sum_columns columns (or edges, or rows) by halves,
/// which gives the parts; then over every 256th part in a lane, and over the lanes by halves.
constexpr int most_sums = 3;  ///< of one pass
constexpr std::uint32_t solver_scalar_count = scalar_count;

/// A range of the arena of a cloth's solver (Hierarchy).
struct ArenaRange {
    std::size_t first = 0, count = 0;
};

/// Numbers of a cloth that are saved before a program, so that its steps can be repeated
/// (PassRunner::put_back): ranges of its solver's arena, the solver's scalars, and a copy of the state.
struct Kept {
    std::uint32_t cloth = 0;
    std::uint32_t parity = 0;
    bool state = true;  ///< false if the program does not overwrite that copy of the state
    std::vector<ArenaRange> numbers = {};
};

/// A sequence of calls with an identity, so that a backend can record it once and replay it.
struct Program {
    std::uint64_t id = 0;  ///< unique among the programs given to one runner
    std::vector<Call> calls;
    std::uint32_t parity_after = 0;  ///< the current copy of the state after the program
    std::vector<Kept> keeps = {};    ///< saved before the first call
};

/// The properties of a pass that wide kernels use.
struct PassKind {
    PassFamily family;
    PassUnit unit;
    HostLoop loop;
};
inline constexpr PassKind pass_kinds[] = {
#define PASS(name, family, unit, reads, writes, sums, loop) \
    {PassFamily::family, PassUnit::unit, HostLoop::loop},
#include "solve/passes.def"
};
constexpr PassFamily family_of(Pass pass) { return pass_kinds[static_cast<std::uint32_t>(pass)].family; }
constexpr PassUnit unit_of(Pass pass) { return pass_kinds[static_cast<std::uint32_t>(pass)].unit; }
constexpr HostLoop host_loop_of(Pass pass) { return pass_kinds[static_cast<std::uint32_t>(pass)].loop; }

constexpr bool is_body_pass(Pass pass) { return family_of(pass) == PassFamily::body; }

/// Solver passes work on the arena and share kernels.
constexpr bool is_solver_pass(Pass pass)
{
    return family_of(pass) != PassFamily::cloth && !is_body_pass(pass);
}
/// Passes of a single invocation.
constexpr bool is_single_pass(Pass pass)
{
    return unit_of(pass) == PassUnit::single || unit_of(pass) == PassUnit::bottom;
}

/// Values in one block of a reduction.
constexpr std::uint32_t block_size = 256;

/// The levels of a tree of measures, stored one after the other. Level 0 has one value per block of nodes.
struct MeasureTree {
    explicit MeasureTree(std::uint32_t node_count);
    struct Level {
        std::uint32_t first = 0, count = 0;
    };
    std::vector<Level> levels;  ///< the last level has one value: the result
    std::uint32_t value_count = 0;
};

}  // namespace pliant
