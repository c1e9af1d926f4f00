#version 460
// Nodes that took part in the last solve of ACAD, and may not in this one.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/mesh.kernel.glsl"
LIVE_NODE_PASS(mesh_clear)
