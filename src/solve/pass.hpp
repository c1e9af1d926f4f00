// Passes and programs: what the methods are written in, and what the backends run.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

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
};

enum class PassSize { node, spring, block };

struct PassDescription {
    const char* name;
    PassSize size;
    std::span<const Resource> reads, writes;
};
const PassDescription& description_of(Pass pass);
std::span<const PassDescription> all_passes();

/// One run of a pass over one cloth.
struct Call {
    Pass pass;
    std::uint32_t cloth = 0;
    std::uint32_t parity = 0;  ///< which copy of the state is current: 0 or 1
    std::uint32_t index = 0;   ///< the step of the frame (for its colliders); of measure_merge, the level
};

/// A sequence of calls with an identity, so that a backend can record it once and replay it.
struct Program {
    std::uint64_t id = 0;  ///< unique among the programs given to one runner
    std::vector<Call> calls;
    std::uint32_t parity_after = 0;  ///< the current copy of the state when it is done
};

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
