#ifndef BODY_SUMS_GLSL
#define BODY_SUMS_GLSL
// Sums of blocks, merged by the fixed tree of 256: by halves within a block; then, by whoever needs the sum of a body,
// every 256th block first, and halves again.
#include "body.glsl"

#ifndef BODY_SUMS_ACCESS
#define BODY_SUMS_ACCESS
#endif
layout(set = 0, binding = 28, std430) BODY_SUMS_ACCESS buffer BodySums { vec4 body_sums[]; };

// Of a body: xyz its centre, w 6 V.
vec4 record_of(uint body) { return body_sums[body_topology[records_at] + body]; }
#endif
