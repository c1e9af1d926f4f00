#version 460
// Bend springs of a mesh, folded onto the sides of their triangles.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/mesh.kernel.glsl"
LIVE_EDGE_PASS(mesh_fold)
