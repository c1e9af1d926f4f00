#version 460
// The multipliers that are used.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/paper.kernel.glsl"
ROW_PASS(paper_multipliers, whole(scalar(scalar_rows)))
