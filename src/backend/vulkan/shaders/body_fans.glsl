#ifndef BODY_FANS_GLSL
#define BODY_FANS_GLSL
// The volume by fans of triangles, each triangle once, summed by block. The including file defines POINT and CHANGE of a
// node.
#include "body_cubics.glsl"

void sum_fans()
{
    BodyBlock block = block_at(fan_blocks_at, gl_WorkGroupID.x);
    VolumeCubic cubic = volume_cubic_of_nothing();
    if (gl_LocalInvocationID.x < block.count) {
        uint start_at = body_topology[fan_start_at] + block.first + gl_LocalInvocationID.x;
        uint entries = body_topology[fans_at], begin = body_topology[start_at], end = body_topology[start_at + 1u];
        uint apex = body_topology[entries + begin];
        vec3 a = POINT(apex), da = CHANGE(apex);
        FanSums fan = fan_of_nothing();
        vec3 side = vec3(0.0f), change = vec3(0.0f);
        for (uint e = begin + 1u; e < end; ++e) {
            uint other = body_topology[entries + e];
            precise vec3 next_side = POINT(other) - a, next_change = CHANGE(other) - da;
            if (e > begin + 1u) fan = fan_add(fan, side, next_side, change, next_change);
            side = next_side;
            change = next_change;
        }
        precise vec3 arm = a - record_of(block.body).xyz;
        cubic = fan_cubic(fan, arm, da);
#ifdef MEASURES  // avoids negative zeros
        cubic.first = cubic.second = cubic.third = 0.0f;
#endif
    }
    cubic = merged_cubic(cubic);
    if (gl_LocalInvocationID.x == 0u) {
        uint at = body_topology[cubic_sums_at] + 2u * gl_WorkGroupID.x;
        body_sums[at] = vec4(cubic.volume, cubic.low, cubic.first, cubic.second);
        body_sums[at + 1u] = vec4(cubic.third, cubic.arm.x, cubic.arm.y, cubic.arm.z);
    }
}
#endif
