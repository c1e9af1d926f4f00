#version 460
// The energy by these forces.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
SINGLE_PASS(contact_resume)
