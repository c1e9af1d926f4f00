#version 460
// The next direction.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/paper.kernel.glsl"
ROW_PASS(paper_direction, whole(scalar(scalar_rows)))
