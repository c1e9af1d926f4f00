#version 460
// The start of a step: where its nodes are, and where inertia, gravity and wind would take them.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
NODE_PASS(step_begin)
