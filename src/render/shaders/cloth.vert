#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "cloth_nodes.glsl"
#include "surfaces.glsl"

layout(location = 0) out vec3 point;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec3 pattern_and_value;
layout(location = 3) flat out vec2 number;

void main()
{
    point = positions[gl_VertexIndex].xyz;
    normal = normals[gl_VertexIndex].xyz;
    pattern_and_value = vec3(pattern[gl_VertexIndex], values[gl_VertexIndex]);
    number = vec2(front_number(gl_InstanceIndex), back_number(gl_InstanceIndex));
    gl_Position = frame.clip_from_world * vec4(point, 1.0);
}
