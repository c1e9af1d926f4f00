#ifndef BODY_CUBICS_GLSL
#define BODY_CUBICS_GLSL
// Sums of the cubic of the exact correction.
#include "body_sums.glsl"

MERGED_IN_GROUP(VolumeCubic, merged_cubic, cubic_values, cubic_lanes, volume_cubic_merge)

VolumeCubic cubic_of_block(uint block)
{
    uint at = body_topology[cubic_sums_at] + 2u * block;
    vec4 a = body_sums[at], b = body_sums[at + 1u];
    VolumeCubic value;
    value.volume = a.x;
    value.low = a.y;
    value.first = a.z;
    value.second = a.w;
    value.third = b.x;
    value.arm = b.yzw;
    return value;
}

VolumeCubic cubic_of_body(BodyPart part)
{
    VolumeCubic value = volume_cubic_of_nothing();
    for (uint k = gl_LocalInvocationID.x; k < part.fan_block_count; k += 256u)
        value = volume_cubic_merge(value, cubic_of_block(part.first_fan_block + k));
    return merged_cubic(value);
}
#endif
