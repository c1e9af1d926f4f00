#version 460
// Counters of the frame, set to zero.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
SINGLE_PASS(solve_reset)
