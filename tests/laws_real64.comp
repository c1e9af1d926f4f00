#version 460
// Compiled by shader_test alone: the laws in double must be GLSL, too.
#extension GL_GOOGLE_include_directive : require
#include "laws.glsl"

layout(local_size_x = 1) in;
layout(set = 0, binding = 0, std430) buffer Values { dvec4 values[]; };

void main()
{
    precise vec3 force = spring_force(values[0].xyz, values[1].xyz, values[2].xyz, values[3].xyz, values[0].w, values[1].w,
                                      values[2].w);
    values[4] = dvec4(force, inverse_sqrt(values[3].w));
}
