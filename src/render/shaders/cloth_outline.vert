#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "cloth_nodes.glsl"
#include "outline.glsl"

vec4 place_of(uint node) { return frame.clip_from_world * vec4(positions[node].xyz, 1.0); }

void main()
{
    uvec4 edge = edges[gl_VertexIndex / 3];
    bool border = edge.w == ~0u;
    outline(place_of(edge.x), place_of(edge.y), place_of(edge.z), place_of(border ? edge.z : edge.w), border,
            false, gl_VertexIndex % 3);
}
