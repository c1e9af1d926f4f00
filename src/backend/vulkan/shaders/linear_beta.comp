#version 460
// How much of the last direction stays in the next.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
SINGLE_PASS(linear_beta)
