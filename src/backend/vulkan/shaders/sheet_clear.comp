#version 460
// What took part in the last solve of ACAD, and may not in this one.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
LIVE_NODE_PASS(sheet_clear)
