#version 460
// Forces and torques of regions.
#extension GL_GOOGLE_include_directive : require
#include "body.glsl"

layout(local_size_x = linear_group) in;
layout(set = 0, binding = binding_external_force, std430) buffer ExternalForce { vec4 external_force[]; };

vec3 vector_at(uint at)
{
    return vec3(uintBitsToFloat(body_topology[at]), uintBitsToFloat(body_topology[at + 1u]),
                uintBitsToFloat(body_topology[at + 2u]));
}

void main()
{
    uint k = gl_GlobalInvocationID.x;
    if (k >= body_topology[load_count_at]) return;
    uint at = body_topology[loads_at] + 7u * k, node = body_topology[at];
    precise vec3 force = region_force(vector_at(at + 1u), vector_at(at + 4u), position_of(node));
    if (parameters.wind_density.w > 0.0f) force = external_force[node].xyz + force;
    external_force[node] = vec4(force, 0.0f);
}
