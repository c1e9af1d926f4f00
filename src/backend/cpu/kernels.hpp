// The hot passes of the CPU backend, compiled once for each instruction set and chosen at start-up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "backend/host/plain_cloth.hpp"
#include "backend/host/solver_context.hpp"

namespace pliant::cpu {

/// Coordinates of several vectors.
struct ConstVectors {
    const float *x, *y, *z;
};
struct Vectors {
    float *x, *y, *z;
};

/// Arguments of a sheet's step, wind, normals and strains; pointers are to NodeLayout planes.
struct SheetArguments {
    const NodeLayout* layout;
    ConstVectors position, velocity;
    Vectors next_position, next_velocity;
    ConstVectors external_force;  ///< x is null without air
    Vectors wind_force;           ///< written by the wind pass
    Vectors normal;               ///< written by the pass of normals
    float* strain;                ///< written by the pass of strains
    const float* inverse_mass;
    const StepConstants<float>* constants;
    const Laws<float>::Collider* colliders;
    std::size_t collider_count;
};

/// Rows [begin, end) of a sheet.
struct RowRange {
    std::ptrdiff_t begin, end;
};

/// Several steps of a sheet in one pass over its rows: each step reads the result of the one before from the
/// cache.
struct SheetStretch {
    static constexpr std::size_t most_steps = 8;
    /// Floats that a step needs besides the state; `row_stride`: floats in a row with padding.
    static constexpr std::size_t carried_size(std::size_t row_stride) { return 2 * 3 * row_stride; }

    const SheetArguments* steps;
    const RowRange* rows;  ///< by step
    std::size_t count;     ///< number of steps, at most `most_steps`
    float* carried;        ///< carried_size for each step
};

/// Springs of a mesh from each node to those of higher index, in slices of 16 nodes; rows as in Slices.
struct MeasuredSlices {
    const std::uint32_t *start, *place;
    const float* rest_length;          ///< m; negative if there is no spring
    const float *stiffness, *bending;  ///< N/m
    const float* counts;               ///< 1 for structural and shear springs, else 0
};

/// Measures of nodes, in blocks of `block_size` consecutive nodes.
struct MeasureArguments {
    const NodeLayout* layout;
    ConstVectors position, velocity;
    const float* state;      ///< records, of a mesh
    MeasuredSlices springs;  ///< of a mesh
    const float* inverse_mass;
    const double* masses;  ///< kg, of each node, pins included
    std::size_t node_count;
    const StepConstants<float>* constants;
    const Laws<float>::Collider* colliders;
    std::size_t collider_count;
    float* measures;  ///< eight numbers for each block
};

/// Floats in a record of a node's state, position and velocity, each padded (records.hpp); and in a vector.
constexpr std::size_t state_size = 8, vector_size = 4;

/// Copies the state of nodes from planes to records.
struct RecordArguments {
    ConstVectors position, velocity;
    float* state;
};

/// Forces of springs. The ends of a spring are offsets of records, in floats. All arrays are padded to
/// multiples of 32 with springs of length zero; `first` and `end` of a call are multiples of 32, too.
struct SpringArguments {
    const float* state;  ///< records
    float* force;        ///< vectors
    const std::uint32_t *first, *second;
    const float *rest_length, *stiffness, *damping;
    const float* bending;  ///< null if all are 0
};

/// Rows of 16 lanes: the k-th entries of 16 neighbouring nodes or fans. Slice s has the rows from start[s] to
/// start[s + 1]; entries are offsets of records, in floats.
struct Slices {
    static constexpr std::size_t lanes = 16;
    const std::uint32_t* start;
    const std::uint32_t* place;
    const float* rest_length;  ///< m; negative if there is no spring. Null for fans.
};

/// Up to 16 consecutive nodes in the planes: those of slice s.
struct NodeRun {
    std::uint32_t offset, count;
};

/// A step from the forces of springs. `springs` has for each entry of a slice the offset of a vector, in
/// floats; plus one if the vector is subtracted.
struct ListArguments {
    const NodeRun* runs;
    const std::uint32_t *start, *springs;
    const float* force;  ///< vectors, by spring; after the last one a zero vector
    ConstVectors position, velocity;
    Vectors next_position, next_velocity;
    float* next_state;            ///< records
    ConstVectors external_force;  ///< x is null if there is none
    const float* inverse_mass;
    const StepConstants<float>* constants;
    const Laws<float>::Collider* colliders;
    std::size_t collider_count;
};

/// Results of a step's sums over a whole body.
struct BodyNumbers {
    Vector3<float> mean, centre;
    float multiplier, pressure;  ///< q, or s of the correction; a sixth of the pressure, Pa
};

/// Values of a pass before they are merged: by number, 16 lanes each.
constexpr std::size_t body_sum_count = 8;
struct LaneSums {
    float lanes[body_sum_count][Slices::lanes];
};

/// Passes of soft bodies over blocks of nodes or fans; pointers are to NodeLayout planes.
struct BodyArguments {
    ConstVectors position, velocity;
    Vectors next_position, next_velocity;
    ConstVectors external_force;  ///< x is null if there is none
    const float* state;           ///< records of the current state
    float* next_state;
    float* ends;  ///< records of the next position and of the direction
    Vectors gradient, direction, blocked;
    float* blocked_count;
    /// By block of nodes: 1 if any node is blocked. If none is, the planes are zero and are neither read nor
    /// written.
    std::uint8_t* any_blocked;
    const float *inverse_mass, *weight;  ///< weight is null if all are 1
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
    /// Runs rows or groups of a pass of the constraint solver.
    void (*solve)(const SolverContext<float>&, const Call&, int first, int end);
    /// Makes the records that such a pass needs on a mesh, for groups of nodes: asks_for_records.
    void (*solver_records)(const SolverContext<float>&, const Call&, int first, int end);
};

/// Kernels in this build that this machine can run, narrowest first; never empty.
std::span<const Kernels* const> available_kernels();
/// Wide kernels made of the baseline instruction set: slow, with the same bits. Tests use them to cover all
/// widths on every machine. Chosen only by name; empty in a build without PLIANT_EVERY_WIDTH
/// (CMakeLists.txt).
std::span<const Kernels* const> test_kernels();
/// Kernels by name, or the widest for an empty name. Throws Error(bad_usage), which lists the names of this
/// machine. With `fast_math`, the kernels of the same instruction set whose results differ between machines;
/// throws if there are none (sse2, and other architectures).
const Kernels& choose_kernels(const std::string& name, bool fast_math = false);

}  // namespace pliant::cpu
