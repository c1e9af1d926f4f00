// The place of the legend, in squares of `unit` pixels from its upper left corner. `LegendText` in render/legend.hpp:
// letters by their index in legend.frag, four per number.
layout(push_constant) uniform Legend {
    uvec4 title, low, high;
} legend;

const vec2 legend_size = vec2(120.0, 26.0), legend_margin = vec2(12.0, 10.0);

float legend_unit() { return max(1.0, floor(min(frame.picture.y / 360.0, frame.picture.x / 400.0))); }
vec2 legend_corner() { return frame.picture.xy - (legend_size + legend_margin) * legend_unit(); }
