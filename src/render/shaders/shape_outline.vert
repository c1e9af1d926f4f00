#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "cloth_nodes.glsl"
#include "shape.glsl"
#include "outline.glsl"

vec4 place_of(uint corner) { return frame.clip_from_world * vec4(placed(positions[corner]), 1.0); }

void main()
{
    uvec4 edge = edges[gl_VertexIndex / 3];
    bool sharp = (edge.w >> 31) != 0u;  // `sharp_edge` in render/shapes.hpp
    outline(place_of(edge.x), place_of(edge.y), place_of(edge.z), place_of(edge.w & 0x7fffffffu), false,
            sharp, gl_VertexIndex % 3);
}
