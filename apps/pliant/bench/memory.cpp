#include "bench/memory.hpp"

#include <malloc.h>

#include "backend/vulkan/device_state.hpp"

namespace pliant::tool {

std::uint64_t memory_in_use()
{
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

std::uint64_t memory_of(Simulation& simulation, std::uint64_t before)
{
    if (DeviceState* state = simulation.device_state()) return state->device()->memory_made();
    return memory_in_use() - before;
}

}  // namespace pliant::tool
