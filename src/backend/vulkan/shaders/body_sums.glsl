#ifndef BODY_SUMS_GLSL
#define BODY_SUMS_GLSL
// Sums of 256 values by one fixed tree: 16 lanes, each of every 16th value in their order; then the lanes in theirs. So
// it is within a block, and then, by whoever needs the sum of a body, over its blocks, every 256th of which are added
// first. Two barriers instead of eight, and on the CPU the lanes are those of a register.
#include "body.glsl"

#ifndef BODY_SUMS_ACCESS
#define BODY_SUMS_ACCESS
#endif
layout(set = 0, binding = binding_body_sums, std430) BODY_SUMS_ACCESS buffer BodySums { vec4 body_sums[]; };

// Of a body: xyz its centre, w 6 V.
vec4 record_of(uint body) { return body_sums[body_topology[records_at] + body]; }

// What the 256 invocations of a group hold, merged by the fixed tree: every 16th value in a lane, then the lanes in order.
#define MERGED_IN_GROUP(Type, name, values, lanes, merge)                            \
    shared Type values[256], lanes[16];                                              \
    Type name(Type value)                                                            \
    {                                                                                \
        uint k = gl_LocalInvocationID.x;                                             \
        values[k] = value;                                                           \
        barrier();                                                                   \
        if (k < 16u) {                                                               \
            for (uint j = 1u; j < 16u; ++j) value = merge(value, values[k + 16u * j]); \
            lanes[k] = value;                                                        \
        }                                                                            \
        barrier();                                                                   \
        value = lanes[0];                                                            \
        for (uint j = 1u; j < 16u; ++j) value = merge(value, lanes[j]);              \
        return value;                                                                \
    }
#endif
