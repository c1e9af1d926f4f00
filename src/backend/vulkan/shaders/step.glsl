#ifndef STEP_GLSL
#define STEP_GLSL
// The end of every step: integrate, then let the colliders speak.
#include "colliders.glsl"

layout(set = 0, binding = 5, std430) readonly buffer ExternalForce { vec4 external_force[]; };

// `total` is all of the force.
void finish_step_of(uint node, vec3 total)
{
    float inverse_mass = position_in[node].w, dt = parameters.gravity_dt.w;
    Motion now;
    now.position = position_of(node);
    now.velocity = velocity_of(node);
    Motion next;
    next.velocity = velocity_step(now.velocity, total, inverse_mass, parameters.gravity_dt.xyz,
                                  parameters.gravity_direction.w, dt);
    next.position = position_step(now.position, next.velocity, dt);
    for (uint k = 0u; k < parameters.collider_count; ++k)
        next = contact_step(now, next, collider_at(push.index, k), parameters.drag_lift_thickness.z, inverse_mass, dt);
    position_out[node] = vec4(next.position, inverse_mass);
    velocity_out[node] = vec4(next.velocity, velocity_in[node].w);
}

void finish_step(uint node, vec3 force)
{
    precise vec3 total = force;
    if (parameters.has_air != 0u) total = total + external_force[node].xyz;
    finish_step_of(node, total);
}
#endif
