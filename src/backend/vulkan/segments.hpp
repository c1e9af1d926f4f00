// Where the commands of a program are cut, so that the host can leave out loops that have ended.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solve/pass.hpp"

namespace pliant::vulkan {

/// Calls that are submitted together: from `first` to before `end`.
struct Segment {
    std::uint32_t first = 0, end = 0;
    /// The host looks at the guard of the first call before it submits, and goes on with the segment `next`
    /// where that skips the call. Else there is nothing to look at.
    bool looks = false;
    std::uint32_t next = 0;
};

/// To look costs a wait for the device, as much as some tens of dispatches that do nothing: so the host looks
/// only where at least so many calls may be skipped, and within loops only where a Newton iteration has
/// ended, or so many calls after the last look.
constexpr std::uint32_t least_skipped = 64, least_between_looks = 256;

/// All calls, in their order; a program without guards is one segment.
std::vector<Segment> segments_of(std::span<const Call> calls);

}  // namespace pliant::vulkan
