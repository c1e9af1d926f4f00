#version 460
// The start of the line search.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
SINGLE_PASS(search_begin)
