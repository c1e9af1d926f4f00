#version 460
// Whether there is something left to do for them.
#extension GL_GOOGLE_include_directive : require
#include "solver_single.glsl"
SINGLE_PASS(contact_check)
