#version 460
// A damped step of block Jacobi at the end of a step.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
NODE_PASS(newton_polish)
