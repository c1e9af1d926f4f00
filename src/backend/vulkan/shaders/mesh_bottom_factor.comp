#version 460
// The operator of a mesh's last level, dense and factored.
#extension GL_GOOGLE_include_directive : require
#include "solver_bottom.glsl"
#include "kernels/mesh.kernel.glsl"
BOTTOM_PASS(mesh_bottom_factor)
