#version 460
// The groups of nodes and edges that take part in a solve of ACAD.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/mesh.kernel.glsl"
ROW_PASS(mesh_live, (max(level.columns, level.edges) + sum_columns - 1) / sum_columns)
