#version 460
// Couplings of a mesh's level, from the operator of the finer one.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/mesh.kernel.glsl"
LIVE_EDGE_PASS(mesh_coarsen_couplings)
