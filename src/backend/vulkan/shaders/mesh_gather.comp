#version 460
// Forces and the operator of a mesh's nodes.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/mesh.kernel.glsl"
LIVE_NODE_PASS(mesh_gather)
