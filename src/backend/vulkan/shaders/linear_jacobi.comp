#version 460
// A preconditioner to compare with: the diagonal blocks.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
LIVE_NODE_PASS(linear_jacobi)
