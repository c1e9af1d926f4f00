#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "shading.glsl"

layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal;
layout(location = 2) flat in vec4 albedo_and_number;
layout(location = 0) out vec4 colour;

void main()
{
    colour = vec4(shade(albedo_and_number.rgb, point, normalize(normal), 0.22, 48.0, 0.0), albedo_and_number.a);
}
