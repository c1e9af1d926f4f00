#version 460
// Whether normal forces are what the iterations before took them for.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
NODE_PASS(contact_change)
