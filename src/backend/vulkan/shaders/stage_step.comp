#version 460
// One stage of explicit Euler or Runge-Kutta. From the second stage on it reads the next state, which the previous stage
// wrote; the last stage ends the step.
#extension GL_GOOGLE_include_directive : require
#define VELOCITY_OUT_ACCESS
#include "list.glsl"
#include "colliders.glsl"

layout(local_size_x = linear_group) in;
layout(set = 0, binding = binding_external_force, std430) readonly buffer ExternalForce { vec4 external_force[]; };
layout(set = 0, binding = binding_spring_force, std430) readonly buffer SpringForce { vec4 spring_forces[]; };
layout(set = 0, binding = binding_slopes, std430) buffer Slopes { vec4 slopes[]; };  // position and velocity, alternating

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
    if (parameters.has_air != 0u) force = force + external_force[node].xyz;

    int stage = int(push.detail);
    bool is_last = stage == 0 || stage == 4;
    float inverse_mass = position_in[node].w, dt = parameters.gravity_dt.w;
    vec3 velocity = stage <= 1 ? velocity_of(node) : velocity_out[node].xyz;
    Motion start;
    start.position = position_of(node);
    start.velocity = velocity_of(node);
    precise vec3 moved = choose(inverse_mass > 0.0f, velocity * dt, vec3(0.0f));
    vec3 change = velocity_change(velocity, force, inverse_mass, parameters.gravity_dt.xyz,
                                  parameters.gravity_direction.w, dt);
    vec3 position_sum = vec3(0.0f), velocity_sum = vec3(0.0f);
    if (stage > 1) {
        position_sum = slopes[2u * node].xyz;
        velocity_sum = slopes[2u * node + 1u].xyz;
    }
    position_sum = stage_sum(stage, position_sum, moved);
    velocity_sum = stage_sum(stage, velocity_sum, change);
    if (!is_last) {
        slopes[2u * node] = vec4(position_sum, 0.0f);
        slopes[2u * node + 1u] = vec4(velocity_sum, 0.0f);
    }
    vec3 velocity_end = settled_velocity(stage_next(stage, start.velocity, velocity_sum, change));
    Motion next;
    next.position = stage_next(stage, start.position, position_sum, moved);
    next.velocity = choose(!is_last || inverse_mass > 0.0f, velocity_end, vec3(0.0f));
    uint colliders = is_last ? parameters.collider_count : 0u;
    for (uint k = 0u; k < colliders; ++k)
        next = contact_step(start, next, collider_at(push.index, k), parameters.drag_lift_thickness.z, inverse_mass, dt);
    position_out[node] = vec4(next.position, inverse_mass);
    velocity_out[node] = vec4(next.velocity, velocity_in[node].w);
}
