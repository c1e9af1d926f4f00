#version 460
// What a correction leaves.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
LIVE_NODE_PASS(level_residual)
