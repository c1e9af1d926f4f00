#ifndef RING_GLSL
#define RING_GLSL
// A node's spring forces and volume gradient, gathered in the order of its ring.
#include "body.glsl"
#include "colliders.glsl"

struct RingSums
{
    vec3 force, gradient;
};

RingSums ring_sums(uint node)
{
    vec3 x = position_of(node), v = velocity_of(node);
    uint start_at = body_topology[ring_start_at] + 2u * node, entries = body_topology[ring_at];
    uint begin = body_topology[start_at], links = body_topology[start_at + 1u], end = body_topology[start_at + 2u];
    precise vec3 force = vec3(0.0f), gradient = vec3(0.0f);
    vec3 first = vec3(0.0f), before = vec3(0.0f);
    for (uint e = begin; e < end; ++e) {
        uint other = body_topology[entries + 2u * e];
        float rest = uintBitsToFloat(body_topology[entries + 2u * e + 1u]);
        vec3 there = position_of(other);
        uint k = e < links ? structural : shear;
        force = force + spring_force(x, there, v, velocity_of(other), rest, component(parameters.stiffness, k),
                                     component(parameters.spring_damping, k));
        if (e >= links) continue;
        precise vec3 side = there - x;
        if (e == begin)
            first = side;
        else
            gradient = ring_add(gradient, before, side);
        before = side;
    }
    RingSums sums;
    sums.force = force;
    sums.gradient = ring_add(gradient, before, first);
    return sums;
}

// The target of a body at the end of this step: x 6 V, y a sixth of the pressure.
vec2 goal_of(uint body)
{
    return collider_rows[parameters.goals_first + push.index * parameters.goals_stride + body].xy;
}
#endif
