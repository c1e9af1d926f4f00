// Memory that a simulation holds.
#pragma once

#include <cstdint>

#include "pliant/simulation.hpp"

namespace pliant::tool {

/// Bytes that the process has allocated and not freed.
std::uint64_t memory_in_use();
/// Bytes that a simulation holds where it runs: on its device, or in the memory that was not in use `before`
/// it.
std::uint64_t memory_of(Simulation& simulation, std::uint64_t before);

}  // namespace pliant::tool
