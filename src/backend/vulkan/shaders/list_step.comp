#version 460
// One step from the list of spring forces: each node gathers the forces of its springs, in the order of its neighbours.
#extension GL_GOOGLE_include_directive : require
#include "list.glsl"
#include "step.glsl"

layout(local_size_x = linear_group) in;
layout(set = 0, binding = binding_spring_force, std430) readonly buffer SpringForce { vec4 spring_forces[]; };

void main()
{
    uint node = gl_GlobalInvocationID.x;
    if (node >= parameters.node_count) return;
    precise vec3 force = vec3(0.0f);
    for (uint e = neighbour_start[node]; e < neighbour_start[node + 1u]; ++e) {
        vec3 f = spring_forces[neighbours[e].y].xyz;
        if (node < neighbours[e].x)
            force = force + f;
        else
            force = force - f;
    }
    finish_step(node, force);
}
