#version 450
#extension GL_GOOGLE_include_directive : require
#include "drawn.glsl"

layout(location = 0) flat in ivec2 across;
layout(location = 1) in vec2 place;
layout(location = 2) flat in float strength;
layout(location = 0) out vec4 colour;

void main()
{
    if (place.x > 1.0 || place.y > 0.5) discard;
    // Not blended with the present colour, so that an outline drawn twice, or where surfaces meet, counts once.
    ivec2 at = ivec2(gl_FragCoord.xy), neighbour = at + (place.y > 0.0 ? -across : across);
    colour = vec4(mix(drawn_at(at).rgb, drawn_at(neighbour).rgb, strength * (0.5 - abs(place.y))), 1.0);
}
