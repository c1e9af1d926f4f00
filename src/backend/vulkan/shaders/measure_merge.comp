#version 460
// One level of the tree of measures.
#extension GL_GOOGLE_include_directive : require
#include "measure.glsl"

layout(local_size_x = block_group) in;

void main()
{
    uint k = gl_GlobalInvocationID.x;
    Measure m = measure_of_nothing();
    if (k < push.source_count) m = stored_measure(push.source_first + k);
    merge_block(m, push.target_first + gl_WorkGroupID.x);
}
