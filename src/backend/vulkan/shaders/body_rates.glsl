#ifndef BODY_RATES_GLSL
#define BODY_RATES_GLSL
// Sums of both sides of eq. (14).
#include "body_sums.glsl"

MERGED_IN_GROUP(VolumeRate, merged_rate, rate_values, rate_lanes, volume_rate_merge)

VolumeRate rate_of_block(uint block)
{
    uint at = body_topology[rate_sums_at] + 2u * block;
    vec4 a = body_sums[at], b = body_sums[at + 1u];
    VolumeRate value;
    value.rate = a.x;
    value.mobility = a.y;
    value.pushed = vec3(a.z, a.w, b.x);
    value.thrust = vec3(b.y, b.z, b.w);
    return value;
}

VolumeRate rate_of_body(BodyPart part)
{
    VolumeRate value = volume_rate_of_nothing();
    for (uint k = gl_LocalInvocationID.x; k < part.block_count; k += 256u)
        value = volume_rate_merge(value, rate_of_block(part.first_block + k));
    return merged_rate(value);
}
#endif
