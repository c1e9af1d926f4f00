#version 460
// The largest force of a constraint at each node of a mesh.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/mesh.kernel.glsl"
NODE_PASS(mesh_multipliers)
