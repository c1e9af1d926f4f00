#version 460
// The multiplier of eq. (14), which every work group computes itself; then integration and contact.
#extension GL_GOOGLE_include_directive : require
#define VELOCITY_OUT_ACCESS
#define BODY_SUMS_ACCESS readonly
#include "body_rates.glsl"
#include "ring.glsl"

layout(local_size_x = block_group) in;
layout(set = 0, binding = binding_gradient, std430) readonly buffer Gradient { vec4 gradients[]; };
layout(set = 0, binding = binding_direction, std430) writeonly buffer Direction { vec4 directions[]; };
layout(set = 0, binding = binding_blocked, std430) writeonly buffer BlockedNodes { vec4 blocked_nodes[]; };

void main()
{
    BodyBlock block = block_at(node_blocks_at, gl_WorkGroupID.x);
    BodyPart part = part_at(block.body);
    VolumeRate sums = rate_of_body(part);
    if (gl_LocalInvocationID.x >= block.count) return;
    float dt = parameters.gravity_dt.w;
    vec3 mean = volume_mean(sums, part.inverse_weight);
    precise float excess = record_of(block.body).w - goal_of(block.body).x;
    float q = volume_multiplier(sums, mean, excess, parameters.rest_lengths_more.y);

    uint node = block.first + gl_LocalInvocationID.x;
    float inverse_mass = position_in[node].w, weight = weight_of(node), thickness = parameters.drag_lift_thickness.z;
    vec3 gradient = gradients[node].xyz;
    Motion now, next;
    now.position = position_of(node);
    now.velocity = velocity_of(node);
    next.velocity = volume_velocity(velocity_out[node].xyz, gradient, mean, inverse_mass, weight, q);
    next.position = position_step(now.position, next.velocity, dt);
    Blocked held = blocked_by_nothing();
    for (uint k = 0u; k < parameters.collider_count; ++k) {
        Collider collider = collider_at(push.index, k);
        held = blocked_with(held, collider, next.position, thickness, inverse_mass);
        next = contact_step(now, next, collider, thickness, inverse_mass, dt);
    }
    position_out[node] = vec4(next.position, inverse_mass);
    velocity_out[node] = vec4(next.velocity, velocity_in[node].w);
    blocked_nodes[node] = vec4(held.normal, held.count);
    directions[node] = vec4(volume_direction(gradient, mean, inverse_mass, weight, held), 0.0f);
}
