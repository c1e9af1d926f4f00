#version 460
// Springs that are limits in this step.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
NODE_PASS(sheet_marks)
