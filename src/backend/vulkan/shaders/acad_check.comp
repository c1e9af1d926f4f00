#version 460
// Whether there is anything to solve.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
SINGLE_PASS(acad_check)
