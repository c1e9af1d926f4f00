#version 460
// What the step is remembered by.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
#include "kernels/paper.kernel.glsl"
SINGLE_PASS(paper_end)
