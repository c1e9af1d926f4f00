#version 460
// The correction of a level, added to that of the finer one.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
CELL_PASS(sheet_prolong, (finer.columns + 1) / 2)
