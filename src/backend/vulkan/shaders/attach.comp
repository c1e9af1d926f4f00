#version 460
// Moves attached nodes to where they are at the end of a step.
#extension GL_GOOGLE_include_directive : require
#include "colliders.glsl"

layout(local_size_x = linear_group) in;

void main()
{
    uint k = gl_GlobalInvocationID.x;
    if (k >= push.source_count) return;
    // The positions follow the colliders, a row for each step; w is the node.
    vec4 place = collider_rows[parameters.attached_first + push.index * push.source_count + k];
    uint node = uint(place.w);
    precise vec3 velocity = (place.xyz - position_of(node)) * parameters.rest_lengths_more.y;
    position_out[node] = vec4(place.xyz, position_in[node].w);
    velocity_out[node] = vec4(velocity, velocity_in[node].w);
}
