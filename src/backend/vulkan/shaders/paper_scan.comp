#version 460
// Sums over blocks of marks: where constraints go in the list of them.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/paper.kernel.glsl"
ROW_PASS(paper_scan, (topology(rows_scan + 2 * scan_level() + 1) + scan_block - 1) / scan_block)
