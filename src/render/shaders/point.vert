#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "cloth_nodes.glsl"

layout(location = 0) out vec2 from_middle;
layout(location = 1) out float depth;

void main()
{
    const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
    vec4 place = points[gl_VertexIndex / 6];
    from_middle = corners[gl_VertexIndex % 6];
    depth = place.w;
    float radius = max(2.0, frame.picture.y / 240.0);  // pixels
    gl_Position = frame.clip_from_world * vec4(place.xyz, 1.0);
    gl_Position.xy += from_middle * radius * 2.0 * frame.picture.zw * gl_Position.w;
    gl_Position.z -= 2e-4 * gl_Position.w;
}
