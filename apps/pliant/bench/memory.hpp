// The memory of a simulation.
#pragma once

#include <cstdint>

#include "pliant/simulation.hpp"

namespace pliant::tool {

/// Bytes that the process has allocated and not freed.
std::uint64_t memory_in_use();
/// Bytes of a simulation on its device, or in host memory beyond `before`, the bytes in use before it was
/// made.
std::uint64_t memory_of(Simulation& simulation, std::uint64_t before);

}  // namespace pliant::tool
