#version 460
// The scalars at the start of a step.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
SINGLE_PASS(solve_begin)
