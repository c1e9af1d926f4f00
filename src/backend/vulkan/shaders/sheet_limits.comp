#version 460
// How many springs a step of springs alone has stretched too far.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
NODE_PASS(sheet_limits)
