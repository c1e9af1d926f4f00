#version 460
// A step along the direction, and the first correction of its residual.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
LIVE_NODE_PASS(linear_update)
