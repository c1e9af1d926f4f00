#version 460
// The residual of a level, from that of the finer one, and its first correction.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
CELL_PASS(sheet_restrict, level.columns)
