#version 460
// The end of a step: its displacements become positions and velocities.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
NODE_PASS(step_end)
