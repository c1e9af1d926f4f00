#version 460
// Energies, forces and stiffnesses of a sheet's springs, at their first nodes.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
NODE_PASS(sheet_springs)
