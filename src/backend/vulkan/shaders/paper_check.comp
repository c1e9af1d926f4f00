#version 460
// Whether the multipliers are found, and which are the best.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
#include "kernels/paper.kernel.glsl"
SINGLE_PASS(paper_check)
