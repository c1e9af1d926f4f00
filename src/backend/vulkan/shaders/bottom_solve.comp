#version 460
// The correction of the last level.
#extension GL_GOOGLE_include_directive : require
#include "solver_bottom.glsl"
BOTTOM_PASS(bottom_solve)
