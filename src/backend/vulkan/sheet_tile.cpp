#include "backend/vulkan/sheet_tile.hpp"

#include <algorithm>

namespace pliant::vulkan {
namespace {

constexpr std::uint32_t spring_reach = 2;           // of a spring, in nodes
constexpr std::uint32_t node_bytes = 7 * 4;         // in shared memory
constexpr std::uint32_t largest_region = 32 << 10;  // bytes, so that several groups fit on a multiprocessor
constexpr std::uint32_t largest_side = 64;          // nodes

/// The numbers of steps per dispatch that add up to `count`. A dispatch with an even number of steps leaves
/// the state in another copy than single steps would, so there must be an even number of these dispatches.
std::vector<std::uint32_t> shares_of(std::uint32_t count, std::uint32_t most)
{
    std::uint32_t whole = count / most;
    if (most % 2 == 0) whole -= whole % 2;
    std::vector<std::uint32_t> shares(whole, most);
    const std::uint32_t odd = most % 2 == 1 ? most : most - 1;
    for (std::uint32_t left = count - whole * most; left > 0; left -= shares.back())
        shares.push_back(std::min(odd, left - (left % 2 == 0 ? 1 : 0)));
    return shares;
}

bool follows(const Call& next, const Call& call)
{
    return next.pass == call.pass && next.cloth == call.cloth && next.guard == call.guard &&
           next.parity != call.parity && next.index == call.index + 1;
}

}  // namespace

SheetTile sheet_tile(const vk::PhysicalDeviceLimits& limits, std::uint32_t steps)
{
    const std::uint32_t nodes = std::min(limits.maxComputeSharedMemorySize, largest_region) / node_bytes;
    SheetTile best;
    double least = 0;  // computed nodes per node of the tile
    for (std::uint32_t columns = 8; columns <= largest_side; columns += 8) {
        const std::uint32_t halo = 2 * spring_reach * steps, region_rows = nodes / (columns + halo);
        if (region_rows <= halo) continue;
        const std::uint32_t rows = std::min(region_rows - halo, largest_side);
        double computed = 0;
        for (std::uint32_t left = 0; left < steps; ++left)
            computed += (rows + 2.0 * spring_reach * left) * (columns + 2.0 * spring_reach * left);
        const double share = computed / (1.0 * steps * rows * columns);
        if (best.rows > 0 && share >= least) continue;
        best = {rows, columns,
                std::min({256u, limits.maxComputeWorkGroupInvocations, limits.maxComputeWorkGroupSize[0]})};
        least = share;
    }
    return best;
}

std::vector<Dispatch> dispatches_of(std::span<const Call> calls, std::uint32_t most)
{
    std::vector<Dispatch> dispatches;
    for (std::size_t k = 0; k < calls.size();) {
        std::uint32_t count = 1;
        if (calls[k].pass == Pass::sheet_step)
            while (k + count < calls.size() && follows(calls[k + count], calls[k + count - 1])) ++count;
        std::uint32_t parity = calls[k].parity;
        for (const std::uint32_t steps : shares_of(count, most)) {
            Dispatch dispatch{calls[k], steps};
            dispatch.call.parity = parity;
            dispatches.push_back(dispatch);
            parity ^= 1;
            k += steps;
        }
    }
    return dispatches;
}

}  // namespace pliant::vulkan
