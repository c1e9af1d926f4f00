#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "shape.glsl"
#include "surfaces.glsl"

layout(location = 0) in vec4 corner;
layout(location = 1) in vec3 corner_normal;
layout(location = 0) out vec3 point;
layout(location = 1) out vec3 normal;
layout(location = 2) flat out vec4 albedo_and_number;

void main()
{
    point = placed(corner);
    normal = turned(tilted(corner_normal));
    albedo_and_number = vec4(placement.colour.rgb, shape_number(gl_InstanceIndex));
    gl_Position = frame.clip_from_world * vec4(point, 1.0);
}
