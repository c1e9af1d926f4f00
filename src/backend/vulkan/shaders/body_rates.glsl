#ifndef BODY_RATES_GLSL
#define BODY_RATES_GLSL
// Both sides of eq. (14), summed up.
#include "body_sums.glsl"

shared VolumeRate rate_values[256], rate_lanes[16];

VolumeRate merged_rate(VolumeRate value)
{
    uint k = gl_LocalInvocationID.x;
    rate_values[k] = value;
    barrier();
    if (k < 16u) {
        for (uint j = 1u; j < 16u; ++j) value = volume_rate_merge(value, rate_values[k + 16u * j]);
        rate_lanes[k] = value;
    }
    barrier();
    value = rate_lanes[0];
    for (uint j = 1u; j < 16u; ++j) value = volume_rate_merge(value, rate_lanes[j]);
    return value;
}

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
