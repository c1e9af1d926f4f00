#version 460
// The residual of a mesh's level, from that of the finer one, and its first correction.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/mesh.kernel.glsl"
LIVE_NODE_PASS(mesh_restrict)
