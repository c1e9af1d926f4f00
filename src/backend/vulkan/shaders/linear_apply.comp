#version 460
// What the operator makes of the direction.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
LIVE_NODE_PASS(linear_apply)
