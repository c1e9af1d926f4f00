#version 460
// The volume of the current state.
#extension GL_GOOGLE_include_directive : require
#define MEASURES
#define POINT(node) position_in[node].xyz
#define CHANGE(node) vec3(0.0f)
#include "cloth.glsl"
#include "body_fans.glsl"

layout(local_size_x = block_group) in;

void main() { sum_fans(); }
