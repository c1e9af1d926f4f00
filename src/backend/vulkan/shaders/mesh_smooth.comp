#version 460
// A smoothing step of the V-cycle on a mesh.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
#include "kernels/mesh.kernel.glsl"
LIVE_NODE_PASS(mesh_smooth)
