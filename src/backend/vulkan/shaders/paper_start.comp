#version 460
// The scalars at the start of conjugate gradients on the multipliers.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
#include "kernels/paper.kernel.glsl"
SINGLE_PASS(paper_start)
