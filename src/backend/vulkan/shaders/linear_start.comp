#version 460
// The scalars at the start of conjugate gradients.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
SINGLE_PASS(linear_start)
