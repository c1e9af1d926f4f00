#version 460
// Normal forces, and friction, for the rest of a step.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
NODE_PASS(contact_keep)
