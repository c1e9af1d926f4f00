#ifndef COLLIDERS_GLSL
#define COLLIDERS_GLSL
// Colliders, which the host places for each step.
#include "cloth.glsl"

layout(set = 0, binding = binding_colliders, std430) readonly buffer Colliders { vec4 collider_rows[]; };

// Collider k of a step.
Collider collider_at(uint step, uint k)
{
    uint of_step = parameters.colliders_rest != 0u ? 0u : step * parameters.collider_count;
    uint first = rows_of_collider * (parameters.colliders_first + of_step + k);
    ColliderRows rows = ColliderRows(collider_rows[first], collider_rows[first + 1u], collider_rows[first + 2u],
                                     collider_rows[first + 3u], collider_rows[first + 4u], collider_rows[first + 5u],
                                     collider_rows[first + 6u], vec4(0.0f));
    Collider c;
    c.centre = rows.centre_kind.xyz;
    c.kind = int(rows.centre_kind.w);
    c.axis_x = rows.axis_x_radius.xyz;
    c.radius = rows.axis_x_radius.w;
    c.axis_y = rows.axis_y_friction.xyz;
    c.friction = rows.axis_y_friction.w;
    c.axis_z = rows.axis_z_response.xyz;
    c.response = int(rows.axis_z_response.w);
    c.half_size = rows.half_size.xyz;
    c.velocity = rows.velocity.xyz;
    c.spin = rows.spin.xyz;
    return c;
}
#endif
