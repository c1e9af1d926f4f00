#version 460
// The volume after contact and pins, and its change along the directions.
#extension GL_GOOGLE_include_directive : require
#define POSITION_OUT_ACCESS readonly
#define POINT(node) position_out[node].xyz
#define CHANGE(node) directions[node].xyz
#include "cloth.glsl"
layout(set = 0, binding = binding_direction, std430) readonly buffer Direction { vec4 directions[]; };
#include "body_fans.glsl"

layout(local_size_x = block_group) in;

void main() { sum_fans(); }
