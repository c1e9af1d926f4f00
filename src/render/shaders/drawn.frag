#version 450
// Copies the surfaces to the picture, with smooth lines where surfaces intersect. Outlines are drawn afterwards.
#extension GL_GOOGLE_include_directive : require
#include "drawn.glsl"

layout(location = 0) out vec4 colour;

// Rounding of depth. Closer surfaces show in a random pattern, which is softened.
const float rounding = 3e-7;

// The part of a pixel covered by a neighbour's surface, where that surface intersects the pixel's own. Depths are linear
// along the line through both, so each surface's depth follows from two pixels on its own side.
float share(float before, float here, float next, float after)
{
    float here_slope = here - before, next_slope = after - next;
    float gap = next - next_slope - here, closing = max(0.0, here_slope - next_slope);
    if (gap < -rounding) return 0.0;
    return max(0.0, (0.5 * closing + 0.35 * rounding - max(0.0, gap)) / (closing + rounding));
}

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 here = drawn_at(at);
    bvec4 other = notEqual(vec4(drawn_at(at + ivec2(1, 0)).a, drawn_at(at - ivec2(1, 0)).a, drawn_at(at + ivec2(0, 1)).a,
                                drawn_at(at - ivec2(0, 1)).a), vec4(here.a));
    int axes = any(other) ? 2 : 0;
    float depth = depth_at(at), most = 0.0, sum = 1e-9;
    vec3 beyond = vec3(0.0);
    for (int axis = 0; axis < axes; ++axis) {
        ivec2 along = ivec2(1 - axis, axis);
        bvec2 differ = axis == 0 ? other.xy : other.zw;
        float before = depth_at(at - along), after = depth_at(at + along);
        float forwards = differ.x ? share(before, depth, after, depth_at(at + 2 * along)) : 0.0;
        float backwards = differ.y ? share(after, depth, before, depth_at(at - 2 * along)) : 0.0;
        most = max(most, max(forwards, backwards));
        sum += forwards + backwards;
        beyond += forwards * drawn_at(at + along).rgb + backwards * drawn_at(at - along).rgb;
    }
    colour = vec4(mix(here.rgb, beyond / sum, most), 1.0);
}
