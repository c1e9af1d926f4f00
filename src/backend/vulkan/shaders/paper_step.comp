#version 460
// The end of a step of the paper's solver: what its nodes do.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/paper.kernel.glsl"
NUMBERED_NODE_PASS(paper_step)
