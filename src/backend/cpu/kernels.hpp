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

/// A sheet's step or wind; pointers are to NodeLayout planes.
struct SheetArguments {
    const NodeLayout* layout;
    ConstVectors position, velocity;
    Vectors next_position, next_velocity;
    ConstVectors external_force;  ///< x is null without air
    Vectors wind_force;           ///< where the wind pass writes
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

/// Measures of a sheet's nodes, by blocks of `block_size` nodes in their order.
struct MeasureArguments {
    const NodeLayout* layout;
    ConstVectors position, velocity;
    const float* inverse_mass;
    const float* masses;  ///< kg, of each node, pinned ones too
    std::size_t node_count;
    const StepConstants<float>* constants;
    const Laws<float>::Collider* colliders;
    std::size_t collider_count;
    float* measures;  ///< eight numbers for each block
};

/// Forces of springs, whose ends are offsets into the planes. All arrays are padded to whole packs of 16 with
/// springs of no length, and `first` and `end` of a call are multiples of 16.
struct SpringArguments {
    ConstVectors position, velocity;
    Vectors force;
    const std::uint32_t *first, *second;
    const float *rest_length, *stiffness, *damping, *bending;
};

/// Rows of 16 lanes: the k-th entry of each of 16 neighbouring nodes or fans. Slice s has the rows from
/// start[s] to start[s + 1]; entries are offsets into the planes.
struct Slices {
    static constexpr std::size_t lanes = 16;
    const std::uint32_t* start;
    const std::uint32_t* offset;
    const float* rest_length;  ///< m; negative where there is no spring. Null for fans.
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
    void (*sheet_wind)(const SheetArguments&, std::size_t first_row, std::size_t end_row);
    void (*sheet_measure)(const MeasureArguments&, std::size_t first_block, std::size_t end_block);
    void (*spring_forces)(const SpringArguments&, std::size_t first, std::size_t end);
    BodyKernel ring_step, volume_gather, volume_step, volume_cubic, volume_correct;
    /// Segments or rows of a pass of the constraint solver.
    void (*solve)(const SolverContext<float>&, const Call&, int first, int end);
};

/// Those this build has and this machine can run, narrowest first; never empty.
std::span<const Kernels* const> available_kernels();
/// By name, or the widest for an empty name; throws Error(bad_usage) that lists the names of this machine.
const Kernels& choose_kernels(const std::string& name);

}  // namespace pliant::cpu
