#version 460
// What a mesh's operator makes of the direction of conjugate gradients.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/mesh.kernel.glsl"
LIVE_NODE_PASS(mesh_apply)
