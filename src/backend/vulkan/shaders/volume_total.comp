#version 460
// The measured volume of each body.
#extension GL_GOOGLE_include_directive : require
#include "body_cubics.glsl"

layout(local_size_x = block_group) in;

void main()
{
    uint body = gl_WorkGroupID.x;
    VolumeCubic cubic = cubic_of_body(part_at(body));
    precise float volume = cubic.volume + cubic.low;
    if (gl_LocalInvocationID.x == 0u) body_sums[body_topology[volumes_at] + body] = vec4(volume, 0.0f, 0.0f, 0.0f);
}
