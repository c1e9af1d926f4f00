#version 460
// Which springs are constraints, and what the others pull with.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/paper.kernel.glsl"
ROW_PASS(paper_springs, topology(rows_springs))
