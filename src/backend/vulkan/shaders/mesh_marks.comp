#version 460
// Springs that are limits in this step.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/mesh.kernel.glsl"
ROW_PASS(mesh_marks, level.edges)
