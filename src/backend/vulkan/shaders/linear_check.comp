#version 460
// Whether conjugate gradients are done.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
SINGLE_PASS(linear_check)
