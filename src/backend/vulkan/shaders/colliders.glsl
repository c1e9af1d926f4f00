#ifndef COLLIDERS_GLSL
#define COLLIDERS_GLSL
// Colliders as the host places them for each step.
#include "cloth.glsl"

layout(set = 0, binding = 6, std430) readonly buffer Colliders { vec4 collider_rows[]; };

// Row k of step s: 8 vec4. As pack_collider() in vulkan_runner.cpp.
Collider collider_at(uint step, uint k)
{
    uint first = 8u * (parameters.rows_first.x + (parameters.colliders_rest != 0u ? 0u : step * parameters.collider_count) + k);
    Collider c;
    vec4 centre_kind = collider_rows[first];
    c.centre = centre_kind.xyz;
    c.kind = int(centre_kind.w);
    vec4 x_radius = collider_rows[first + 1u];
    c.axis_x = x_radius.xyz;
    c.radius = x_radius.w;
    vec4 y_friction = collider_rows[first + 2u];
    c.axis_y = y_friction.xyz;
    c.friction = y_friction.w;
    vec4 z_response = collider_rows[first + 3u];
    c.axis_z = z_response.xyz;
    c.response = int(z_response.w);
    c.half_size = collider_rows[first + 4u].xyz;
    c.velocity = collider_rows[first + 5u].xyz;
    c.spin = collider_rows[first + 6u].xyz;
    return c;
}
#endif
