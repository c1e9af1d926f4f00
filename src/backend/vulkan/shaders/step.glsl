#ifndef STEP_GLSL
#define STEP_GLSL
// The end of every step: integration, then contact.
#include "colliders.glsl"

layout(set = 0, binding = binding_external_force, std430) readonly buffer ExternalForce { vec4 external_force[]; };

// A node after a step of the frame; `total` is the total force.
Motion stepped(Motion now, vec3 total, float inverse_mass, uint step)
{
    float dt = parameters.gravity_dt.w;
    Motion next;
    next.velocity = velocity_step(now.velocity, total, inverse_mass, parameters.gravity_dt.xyz,
                                  parameters.gravity_direction.w, dt);
    next.position = position_step(now.position, next.velocity, dt);
    for (uint k = 0u; k < parameters.collider_count; ++k)
        next = contact_step(now, next, collider_at(step, k), parameters.drag_lift_thickness.z, inverse_mass, dt);
    return next;
}

void put_state(uint node, Motion next, float inverse_mass)
{
    position_out[node] = vec4(next.position, inverse_mass);
    velocity_out[node] = vec4(next.velocity, velocity_in[node].w);
}

void finish_step_of(uint node, vec3 total)
{
    Motion now;
    now.position = position_of(node);
    now.velocity = velocity_of(node);
    float inverse_mass = position_in[node].w;
    put_state(node, stepped(now, total, inverse_mass, push.index), inverse_mass);
}

vec3 total_force(uint node, vec3 force)
{
    precise vec3 total = force;
    if (parameters.has_air != 0u) total = total + external_force[node].xyz;
    return total;
}

void finish_step(uint node, vec3 force)
{
    finish_step_of(node, total_force(node, force));
}
#endif
