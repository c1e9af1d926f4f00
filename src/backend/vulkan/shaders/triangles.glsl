#ifndef TRIANGLES_GLSL
#define TRIANGLES_GLSL
// Triangles of a mesh, and those around each node.
#include "cloth.glsl"

layout(set = 0, binding = binding_triangles, std430) readonly buffer Triangles { uint triangle_nodes[]; };  // three each
layout(set = 0, binding = binding_triangle_start, std430) readonly buffer TriangleStart { uint triangle_start[]; };
layout(set = 0, binding = binding_node_triangles, std430) readonly buffer NodeTriangles { uint node_triangles[]; };

uvec3 triangle_at(uint t) { return uvec3(triangle_nodes[3u * t], triangle_nodes[3u * t + 1u], triangle_nodes[3u * t + 2u]); }
#endif
