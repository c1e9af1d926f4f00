#ifndef MEASURE_NODE_GLSL
#define MEASURE_NODE_GLSL
// The measures of a node itself, without its springs.
#include "colliders.glsl"
#include "measure.glsl"

Measure with_node(Measure springs, uint node)
{
    vec3 x = position_of(node);
    Measure m = measure_node(springs, x, velocity_of(node), velocity_in[node].w, parameters.gravity_direction.xyz);
    if (position_in[node].w > 0.0f)
        for (uint k = 0u; k < parameters.collider_count; ++k) {
            precise float depth = parameters.drag_lift_thickness.z - collider_gap(collider_at(push.index, k), x).w;
            m.max_penetration = largest(depth, m.max_penetration);
        }
    return m;
}
#endif
