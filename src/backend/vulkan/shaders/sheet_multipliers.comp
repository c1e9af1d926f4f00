#version 460
// The largest force of a constraint at each node of a sheet.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
NODE_PASS(sheet_multipliers)
