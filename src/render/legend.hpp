// The legend of a picture whose cloth is coloured by values.
#pragma once

#include <array>
#include <cstdint>

#include "render/overlay.hpp"

namespace pliant {

/// The push constants of shaders/legend.glsl: texts of up to 16 letters, a byte each.
struct LegendText {
    std::array<std::uint32_t, 4> title, low, high;
};

/// Letters that the legend lacks become blanks.
LegendText legend_text(const ValueScale& scale);

}  // namespace pliant
