#version 460
// The exact correction: every work group computes the root of the cubic itself.
#extension GL_GOOGLE_include_directive : require
#define POSITION_OUT_ACCESS
#define VELOCITY_OUT_ACCESS
#include "body_cubics.glsl"
#include "ring.glsl"

layout(local_size_x = block_group) in;
layout(set = 0, binding = binding_direction, std430) readonly buffer Direction { vec4 directions[]; };

void main()
{
    BodyBlock block = block_at(node_blocks_at, gl_WorkGroupID.x);
    BodyPart part = part_at(block.body);
    VolumeCubic cubic = cubic_of_body(part);
    float wanted = goal_of(block.body).x;
    float s = volume_root(cubic, wanted);
    if (gl_LocalInvocationID.x == 0u && gl_WorkGroupID.x == part.first_block) {
        vec4 record = record_of(block.body);
        precise vec3 centre = record.xyz + cubic.arm * part.inverse_fans;
        precise float volume = wanted + volume_excess(cubic, wanted, s);
        body_sums[body_topology[records_at] + block.body] = vec4(centre, volume);
    }
    if (gl_LocalInvocationID.x >= block.count) return;
    uint node = block.first + gl_LocalInvocationID.x;
    Motion end;
    end.position = position_out[node].xyz;
    end.velocity = velocity_out[node].xyz;
    end = volume_corrected(end, directions[node].xyz, s, parameters.rest_lengths_more.y);
    position_out[node] = vec4(end.position, position_in[node].w);
    velocity_out[node] = vec4(end.velocity, velocity_in[node].w);
}
