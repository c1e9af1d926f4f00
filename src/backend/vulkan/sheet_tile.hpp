// Several steps of a sheet in one dispatch (shaders/sheet_steps.comp): which calls are combined, and the size
// of tiles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "solve/pass.hpp"

namespace pliant::vulkan {

constexpr std::uint32_t most_sheet_steps = 4;  ///< per dispatch

/// The constants of sheet_steps.comp: rows and columns of a group's tile, and its invocations.
struct SheetTile {
    std::uint32_t rows = 0, columns = 0, invocations = 0;
};
/// The fitting tile with the fewest additional nodes; no rows if none fits.
SheetTile sheet_tile(const vk::PhysicalDeviceLimits& limits, std::uint32_t steps);

/// Calls in one dispatch: the first of them, and the number of a sheet's steps.
struct Dispatch {
    Call call;
    std::uint32_t steps = 1;
};
/// All calls in order; up to `most` consecutive steps of a sheet are combined. A dispatch takes the state
/// from one copy to the other, so within such a run the copies differ from those of the calls; after it they
/// agree again.
std::vector<Dispatch> dispatches_of(std::span<const Call> calls, std::uint32_t most);

}  // namespace pliant::vulkan
