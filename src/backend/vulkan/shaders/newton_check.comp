#version 460
// Whether Newton's method is done.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
SINGLE_PASS(newton_check)
