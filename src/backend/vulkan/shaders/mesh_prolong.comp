#version 460
// The correction of a mesh's level, added to that of the finer one.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/mesh.kernel.glsl"
FINER_PASS(mesh_prolong)
