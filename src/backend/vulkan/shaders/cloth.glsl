// Data of a cloth for every compute shader.
#ifndef CLOTH_GLSL
#define CLOTH_GLSL
#extension GL_GOOGLE_include_directive : require
#include "laws.glsl"
#include "kernels/level.glsl"
#include "layout.glsl"

const uint structural = 0u, shear = 1u, bend = 2u;

layout(set = 0, binding = binding_parameters, std140) uniform ParametersOfCloth { Parameters parameters; };
layout(push_constant) uniform PushOfCall { Push push; };

layout(set = 0, binding = binding_position_in, std430) readonly buffer PositionIn { vec4 position_in[]; };  // w: inverse mass, 1/kg
#ifndef VELOCITY_IN_ACCESS
#define VELOCITY_IN_ACCESS readonly
#endif
layout(set = 0, binding = binding_velocity_in, std430) VELOCITY_IN_ACCESS buffer VelocityIn { vec4 velocity_in[]; };  // w: mass, kg
#ifndef POSITION_OUT_ACCESS
#define POSITION_OUT_ACCESS writeonly
#endif
layout(set = 0, binding = binding_position_out, std430) POSITION_OUT_ACCESS buffer PositionOut { vec4 position_out[]; };
#ifndef VELOCITY_OUT_ACCESS
#define VELOCITY_OUT_ACCESS writeonly
#endif
layout(set = 0, binding = binding_velocity_out, std430) VELOCITY_OUT_ACCESS buffer VelocityOut { vec4 velocity_out[]; };

vec3 position_of(uint node) { return position_in[node].xyz; }
vec3 velocity_of(uint node) { return velocity_in[node].xyz; }

float rest_length_of(uint k) { return k < 4u ? parameters.rest_lengths[k] : parameters.rest_lengths_more[k - 4u]; }
float component(vec4 a, uint k) { return a[k]; }
#endif
