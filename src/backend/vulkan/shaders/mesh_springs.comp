#version 460
// Energies, forces and stiffnesses of a mesh's springs.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/mesh.kernel.glsl"
LIVE_EDGE_PASS(mesh_springs)
