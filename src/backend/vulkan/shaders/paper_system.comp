#version 460
// Rows of the system of the multipliers.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/paper.kernel.glsl"
ROW_PASS(paper_system, whole(scalar(scalar_rows)))
