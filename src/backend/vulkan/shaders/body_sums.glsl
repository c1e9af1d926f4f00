#ifndef BODY_SUMS_GLSL
#define BODY_SUMS_GLSL
// Sums of 256 values in one fixed tree: 16 lanes, each the sum of every 16th value in order; then the lanes in order. This
// holds within a block. Each pass that needs the sum of a body merges its blocks in the same tree, after adding every 256th.
// It needs two barriers instead of eight, and on the CPU the lanes are those of a register.
#include "body.glsl"

#ifndef BODY_SUMS_ACCESS
#define BODY_SUMS_ACCESS
#endif
layout(set = 0, binding = binding_body_sums, std430) BODY_SUMS_ACCESS buffer BodySums { vec4 body_sums[]; };

// Of a body: xyz its centre, w 6 V.
vec4 record_of(uint body) { return body_sums[body_topology[records_at] + body]; }

// Merges the values of the 256 invocations of a group in the fixed tree: every 16th value in a lane, then the lanes in
// order.
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
