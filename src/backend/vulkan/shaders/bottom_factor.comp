#version 460
// The operator of the last level, dense and factored.
#extension GL_GOOGLE_include_directive : require
#include "solver_bottom.glsl"
BOTTOM_PASS(bottom_factor)
