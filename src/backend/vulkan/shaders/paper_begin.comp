#version 460
// The start of a step of the paper's solver.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/paper.kernel.glsl"
NODE_PASS(paper_begin)
