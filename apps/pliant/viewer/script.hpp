// A scripted session: timed events from a JSON file. docs/viewer.md has the format.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viewer/event.hpp"

namespace pliant::tool {

struct TimedEvent {
    std::uint64_t frame = 0;  ///< display frame, 60 per second
    Event event;
};

/// Sorted by frame. Throws Error(bad_input) that names file, place and value.
std::vector<TimedEvent> read_script(const std::string& file);

constexpr double script_frame_rate = 60;  // 1/s

}  // namespace pliant::tool
