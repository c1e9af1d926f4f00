#version 460
// Energies, forces and stiffnesses of a mesh's springs.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/mesh.kernel.glsl"
ROW_PASS(mesh_springs, level.edges)
