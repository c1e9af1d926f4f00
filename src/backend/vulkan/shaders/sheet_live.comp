#version 460
// The rows that take part in a solve of ACAD.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
ROW_PASS(sheet_live, level.rows)
