#version 460
// Edge-centric: computes the force of each spring on its first node, once.
#extension GL_GOOGLE_include_directive : require
#include "list.glsl"

layout(local_size_x = linear_group) in;
layout(set = 0, binding = binding_spring_force, std430) writeonly buffer SpringForce { vec4 spring_forces[]; };

void main()
{
    uint s = gl_GlobalInvocationID.x;
    if (s >= parameters.spring_count) return;
    uint i = springs[s].x, j = springs[s].y, k = spring_class_of(s);
    precise float stiffness = component(parameters.stiffness, k) * spring_scale_of(s);
    precise float damping = component(parameters.spring_damping, k) * spring_scale_of(s);
    precise vec3 force = spring_force(position_of(i), position_of(j), velocity_of(i), velocity_of(j), spring_rest_of(s),
                                      stiffness, damping);
    force = force + bending_force(position_of(i), position_of(j), spring_bending_of(s));
    spring_forces[s] = vec4(force, 0.0f);
}
