#version 460
// What the limits of springs remember of a step.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
NODE_PASS(sheet_multiply)
