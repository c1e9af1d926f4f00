// Several steps of a sheet in one dispatch (shaders/sheet_steps.comp): which calls are taken together, and by
// tiles of what size.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "solve/pass.hpp"

namespace pliant::vulkan {

constexpr std::uint32_t most_sheet_steps = 4;  ///< of a dispatch

/// What the constants of sheet_steps.comp are set to: nodes that a group leaves, and its invocations.
struct SheetTile {
    std::uint32_t rows = 0, columns = 0, invocations = 0;
};
/// The tile for which the fewest nodes are computed beside it, of those that fit; no rows where none does.
SheetTile sheet_tile(const vk::PhysicalDeviceLimits& limits, std::uint32_t steps);

/// Calls that are one dispatch: the first of them, and how many steps of a sheet they are.
struct Dispatch {
    Call call;
    std::uint32_t steps = 1;
};
/// All calls in their order; up to `most` steps of a sheet with nothing between them are taken together. A
/// dispatch takes the state from one copy to the other, so that within such a run the copies are not those of
/// the calls; behind it they are again.
std::vector<Dispatch> dispatches_of(std::span<const Call> calls, std::uint32_t most);

}  // namespace pliant::vulkan
