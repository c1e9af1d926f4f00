// The hot passes of the CPU backend, compiled once for each instruction set and chosen at start-up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "backend/host/plain_cloth.hpp"
#include "backend/host/solver_context.hpp"

namespace pliant::cpu {

/// Coordinates of a set of vectors.
struct ConstVectors {
    const float *x, *y, *z;
};
struct Vectors {
    float *x, *y, *z;
};

/// A sheet's step, wind, normals or strains; pointers are to NodeLayout planes.
struct SheetArguments {
    const NodeLayout* layout;
    ConstVectors position, velocity;
    Vectors next_position, next_velocity;
    ConstVectors external_force;  ///< x is null without air
    Vectors wind_force;           ///< where the wind pass writes
    Vectors normal;               ///< and that of normals
    float* strain;                ///< and that of strains
    const float* inverse_mass;
    const StepConstants<float>* constants;
    const Laws<float>::Collider* colliders;
    std::size_t collider_count;
};

/// Rows of a sheet, from `begin` to before `end`.
struct RowRange {
    std::ptrdiff_t begin, end;
};

/// Several steps of a sheet in one pass over its rows: a step finds its state where the one before left it.
struct SheetStretch {
    static constexpr std::size_t most_steps = 8;
    /// Floats that a step needs beside the state, of a sheet with so many floats in a row with its pads.
    static constexpr std::size_t carried_size(std::size_t row_stride) { return 2 * 3 * row_stride; }

    const SheetArguments* steps;
    const RowRange* rows;  ///< of each step
    std::size_t count;     ///< of steps, at most `most_steps`
    float* carried;        ///< carried_size for each step
};

/// Springs of a mesh from each node to those of higher index, in slices of 16 nodes: rows as of Slices.
struct MeasuredSlices {
    const std::uint32_t *start, *place;
    const float* rest_length;          ///< m; negative where there is no spring
    const float *stiffness, *bending;  ///< N/m
    const float* counts;               ///< 1 of structural and shear springs, else 0
};

/// Measures of nodes, by blocks of `block_size` nodes in their order.
struct MeasureArguments {
    const NodeLayout* layout;
    ConstVectors position, velocity;
    const float* state;      ///< records, of a mesh
    MeasuredSlices springs;  ///< of a mesh
    const float* inverse_mass;
    const double* masses;  ///< kg, of each node, pinned ones too
    std::size_t node_count;
    const StepConstants<float>* constants;
    const Laws<float>::Collider* colliders;
    std::size_t collider_count;
    float* measures;  ///< eight numbers for each block
};

/// Floats of a node's state in a record: position and velocity, with a pad behind each (records.hpp); and of
/// a vector.
constexpr std::size_t state_size = 8, vector_size = 4;

/// The state of nodes, from planes to records.
struct RecordArguments {
    ConstVectors position, velocity;
    float* state;
};

/// Forces of springs, whose ends are places of records, in floats. All arrays are padded to multiples of 32
/// with springs of no length, and `first` and `end` of a call are such, too.
struct SpringArguments {
    const float* state;  ///< records
    float* force;        ///< vectors
    const std::uint32_t *first, *second;
    const float *rest_length, *stiffness, *damping;
    const float* bending;  ///< null where all are 0
};

/// Rows of 16 lanes: the k-th entry of each of 16 neighbouring nodes or fans. Slice s has the rows from
/// start[s] to start[s + 1]; entries are places of records, in floats.
struct Slices {
    static constexpr std::size_t lanes = 16;
    const std::uint32_t* start;
    const std::uint32_t* place;
    const float* rest_length;  ///< m; negative where there is no spring. Null for fans.
};

/// Up to 16 nodes side by side in the planes: those of slice s.
struct NodeRun {
    std::uint32_t offset, count;
};

/// A step from the forces of springs. `springs` has the place of a vector for each entry of a slice, in
/// floats, and one more where it is subtracted.
struct ListArguments {
    const NodeRun* runs;
    const std::uint32_t *start, *springs;
    const float* force;  ///< vectors, of springs; behind the last one a vector of 0
    ConstVectors position, velocity;
    Vectors next_position, next_velocity;
    float* next_state;            ///< records
    ConstVectors external_force;  ///< x is null without any
    const float* inverse_mass;
    const StepConstants<float>* constants;
    const Laws<float>::Collider* colliders;
    std::size_t collider_count;
};

/// What a step of a body has found out about it as a whole.
struct BodyNumbers {
    Vector3<float> mean, centre;
    float multiplier, pressure;  ///< q, or s of the correction; a sixth of the pressure
};

/// Values that a pass leaves to be merged: by number, 16 lanes each.
constexpr std::size_t body_sum_count = 8;
struct LaneSums {
    float lanes[body_sum_count][Slices::lanes];
};

/// Passes of soft bodies over blocks of nodes or fans; pointers are to NodeLayout planes.
struct BodyArguments {
    ConstVectors position, velocity;
    Vectors next_position, next_velocity;
    ConstVectors external_force;  ///< x is null without any
    const float* state;           ///< records of the current state
    float* next_state;
    float* ends;  ///< records of the next position and of the direction
    Vectors gradient, direction, blocked;
    float* blocked_count;
    /// By block of nodes: 1 where some node is blocked. Elsewhere the planes hold zeros, and nobody reads or
    /// writes them.
    std::uint8_t* any_blocked;
    const float *inverse_mass, *weight;  ///< weight is null where all are 1
    std::size_t first_offset;            ///< of node 0
    const BodyBlock* blocks;             ///< of nodes, or of fans
    Slices ring, links, fans;            ///< 16 slices for each block
    const BodyNumbers* numbers;          ///< by body
    LaneSums* sums;                      ///< by block
    bool has_links, has_pressure, measures;
    const StepConstants<float>* constants;
    const Laws<float>::Collider* colliders;
    std::size_t collider_count;
};
using BodyKernel = void (*)(const BodyArguments&, std::size_t first_block, std::size_t end_block);

struct Kernels {
    const char* name;
    void (*sheet_steps)(const SheetStretch&);
    using RowKernel = void (*)(const SheetArguments&, std::size_t first_row, std::size_t end_row);
    RowKernel sheet_wind, sheet_normal, sheet_strain;
    void (*sheet_measure)(const MeasureArguments&, std::size_t first_block, std::size_t end_block);
    void (*mesh_measure)(const MeasureArguments&, std::size_t first_block, std::size_t end_block);
    void (*record_states)(const RecordArguments&, std::size_t first, std::size_t end);
    void (*spring_forces)(const SpringArguments&, std::size_t first, std::size_t end);
    void (*list_step)(const ListArguments&, std::size_t first_slice, std::size_t end_slice);
    BodyKernel ring_step, volume_gather, volume_step, volume_cubic, volume_correct;
    /// Rows or groups of a pass of the constraint solver.
    void (*solve)(const SolverContext<float>&, const Call&, int first, int end);
    /// The records that such a pass asks for on a mesh, of groups of nodes: asks_for_records.
    void (*solver_records)(const SolverContext<float>&, const Call&, int first, int end);
};

/// Those this build has and this machine can run, narrowest first; never empty.
std::span<const Kernels* const> available_kernels();
/// Wider ones by what every machine has, slow and of the same bits: for tests, which therefore see all widths
/// wherever they run. Only by name; empty in a build without them (PLIANT_EVERY_WIDTH of CMakeLists.txt).
std::span<const Kernels* const> test_kernels();
/// By name, or the widest for an empty name; throws Error(bad_usage) that lists the names of this machine.
/// With `fast_math` those of the same instruction set whose results are not the same everywhere; throws where
/// there are none (sse2, and other architectures).
const Kernels& choose_kernels(const std::string& name, bool fast_math = false);

}  // namespace pliant::cpu
