#version 460
// Whether the step that was tried is taken.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
SINGLE_PASS(search_check)
