#version 460
// How far to go along the direction.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
#include "kernels/paper.kernel.glsl"
SINGLE_PASS(paper_alpha)
