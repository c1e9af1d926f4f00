#version 460
// The operator of a level, from that of the finer one.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
CELL_PASS(sheet_coarsen, level.columns)
