#version 460
// How far to go along the direction.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
SINGLE_PASS(linear_alpha)
