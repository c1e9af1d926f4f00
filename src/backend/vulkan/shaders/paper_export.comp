#version 460
// The largest force of a constraint at each node, by the solver of the paper.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/paper.kernel.glsl"
NODE_PASS(paper_export)
