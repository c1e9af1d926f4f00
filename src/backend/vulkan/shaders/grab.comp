#version 460
// The velocity of the hand's node before the step.
#extension GL_GOOGLE_include_directive : require
#define VELOCITY_IN_ACCESS
#include "cloth.glsl"

layout(local_size_x = 1) in;

void main()
{
    uint node = parameters.grabbed_node;
    velocity_in[node].xyz = grabbed_velocity(position_of(node), velocity_of(node), parameters.grab_target.xyz,
                                             parameters.gravity_dt.xyz, parameters.grab_target.w,
                                             parameters.rest_lengths_more.z, parameters.gravity_dt.w);
}
