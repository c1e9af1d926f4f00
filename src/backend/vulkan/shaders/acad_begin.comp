#version 460
// The start of a step that springs alone have made too long.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
LIVE_NODE_PASS(acad_begin)
