#version 460
// A step along the direction.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/paper.kernel.glsl"
ROW_PASS(paper_update, whole(scalar(scalar_rows)))
