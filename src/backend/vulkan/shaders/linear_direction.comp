#version 460
// The next direction of conjugate gradients.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
LIVE_NODE_PASS(linear_direction)
