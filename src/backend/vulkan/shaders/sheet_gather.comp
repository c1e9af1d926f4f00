#version 460
// Forces and the operator of a sheet's nodes.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
NODE_PASS(sheet_gather)
