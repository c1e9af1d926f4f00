#version 460
// What the system's matrix makes of the direction.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/paper.kernel.glsl"
ROW_PASS(paper_apply, whole(scalar(scalar_rows)))
