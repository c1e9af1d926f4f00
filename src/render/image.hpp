// A picture in host memory.
#pragma once

#include <cstdint>
#include <vector>

namespace pliant {

/// Rows from the top, pixels from the left, four bytes each: sRGB red, green, blue, and alpha.
struct Image {
    std::uint32_t width = 0, height = 0;  ///< pixels
    std::vector<std::uint8_t> rgba;
};

}  // namespace pliant
