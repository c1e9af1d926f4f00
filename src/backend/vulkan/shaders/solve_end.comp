#version 460
// What the step is remembered by.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
SINGLE_PASS(solve_end)
