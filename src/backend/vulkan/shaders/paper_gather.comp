#version 460
// The forces on nodes without constraints, and the velocities that they give.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/paper.kernel.glsl"
NUMBERED_NODE_PASS(paper_gather)
