// Cuts the commands of a program into segments, so that the host can skip loops that have ended.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solve/pass.hpp"

namespace pliant::vulkan {

/// Calls [first, end) that are submitted together.
struct Segment {
    std::uint32_t first = 0, end = 0;
    /// Whether the host tests the guard of the first call before it submits the segment. If the call is
    /// skipped, the host continues with the segment `next`.
    bool looks = false;
    std::uint32_t next = 0;
};

/// A test waits for the device, which costs as much as some tens of empty dispatches. So the host tests only
/// where at least `least_skipped` calls may be skipped; within loops only after a Newton iteration, or
/// `least_between_looks` calls after the last test.
constexpr std::uint32_t least_skipped = 64, least_between_looks = 256;

/// All calls in order; a program without guards is one segment.
std::vector<Segment> segments_of(std::span<const Call> calls);

}  // namespace pliant::vulkan
