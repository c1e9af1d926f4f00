#version 460
// A smoothing step of the V-cycle.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
LIVE_NODE_PASS(level_smooth)
