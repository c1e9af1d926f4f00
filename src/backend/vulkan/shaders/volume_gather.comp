#version 460
// Springs, gradient, the velocity by forces alone, and both sides of eq. (14), summed by block.
#extension GL_GOOGLE_include_directive : require
#include "body_rates.glsl"
#include "ring.glsl"

layout(local_size_x = block_group) in;
layout(set = 0, binding = binding_external_force, std430) readonly buffer ExternalForce { vec4 external_force[]; };
layout(set = 0, binding = binding_gradient, std430) writeonly buffer Gradient { vec4 gradients[]; };
layout(set = 0, binding = binding_blocked, std430) readonly buffer BlockedNodes { vec4 blocked_nodes[]; };

void main()
{
    BodyBlock block = block_at(node_blocks_at, gl_WorkGroupID.x);
    VolumeRate rate = volume_rate_of_nothing();
    if (gl_LocalInvocationID.x < block.count) {
        uint node = block.first + gl_LocalInvocationID.x;
        RingSums sums = ring_sums(node);
        precise vec3 force = sums.force;
        if (parameters.has_air != 0u) force = force + external_force[node].xyz;
        if (body_topology[pressure_at] != 0u) force = force + sums.gradient * goal_of(block.body).y;
        float inverse_mass = position_in[node].w;
        vec3 next = velocity_step(velocity_of(node), force, inverse_mass, parameters.gravity_dt.xyz,
                                  parameters.gravity_direction.w, parameters.gravity_dt.w);
        Blocked held;
        held.normal = blocked_nodes[node].xyz;
        held.count = blocked_nodes[node].w;
        gradients[node] = vec4(sums.gradient, 0.0f);
        velocity_out[node] = vec4(next, velocity_in[node].w);
        rate = volume_rate_of(sums.gradient, next, inverse_mass, weight_of(node), held);
    }
    rate = merged_rate(rate);
    if (gl_LocalInvocationID.x == 0u) {
        uint at = body_topology[rate_sums_at] + 2u * gl_WorkGroupID.x;
        body_sums[at] = vec4(rate.rate, rate.mobility, rate.pushed.x, rate.pushed.y);
        body_sums[at + 1u] = vec4(rate.pushed.z, rate.thrust.x, rate.thrust.y, rate.thrust.z);
    }
}
