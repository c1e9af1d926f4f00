#version 450
// From the surfaces to the picture: smooth lines where surfaces cut through each other. Outlines come after it.
#extension GL_GOOGLE_include_directive : require
#include "drawn.glsl"

layout(location = 0) out vec4 colour;

// Of depths. Surfaces closer to each other than that show in a random pattern, which is made softer.
const float rounding = 3e-7;

// The part of a pixel that a neighbour's surface has, where it runs through that of the pixel. Depths are linear along the
// line through both, so that each surface's is known from two pixels on its own side.
float share(float before, float here, float next, float after)
{
    float here_slope = here - before, next_slope = after - next;
    float gap = next - next_slope - here, closing = max(0.0, here_slope - next_slope);
    if (gap < -rounding) return 0.0;
    return max(0.0, (0.5 * closing + 0.35 * rounding - max(0.0, gap)) / (closing + rounding));
}

void main()
{
    const ivec2 sides[4] = ivec2[](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 here = drawn_at(at);
    int others = 0;
    for (int k = 0; k < 4; ++k) others += drawn_at(at + sides[k]).a != here.a ? 1 : 0;
    float depth = others > 0 ? depth_at(at) : 0.0, most = 0.0, sum = 1e-9;
    vec3 beyond = vec3(0.0);
    for (int k = 0; k < (others > 0 ? 4 : 0); ++k) {
        ivec2 side = sides[k];
        vec4 next = drawn_at(at + side);
        float part = next.a != here.a ? share(depth_at(at - side), depth, depth_at(at + side), depth_at(at + 2 * side)) : 0.0;
        most = max(most, part);
        sum += part;
        beyond += part * next.rgb;
    }
    colour = vec4(mix(here.rgb, beyond / sum, most), 1.0);
}
