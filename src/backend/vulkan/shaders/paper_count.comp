#version 460
// How many constraints there are.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
#include "kernels/paper.kernel.glsl"
SINGLE_PASS(paper_count)
