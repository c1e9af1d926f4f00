#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "shape.glsl"

layout(location = 0) out vec3 point;
layout(location = 1) out vec3 normal;
layout(location = 2) flat out vec3 albedo;

void main()
{
    point = placed_corner();
    normal = turned(corner_normal);
    albedo = placement.colour.rgb;
    gl_Position = frame.clip_from_world * vec4(point, 1.0);
}
