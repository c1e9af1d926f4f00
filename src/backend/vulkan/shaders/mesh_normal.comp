#version 460
// Normals of a mesh: sums of the area vectors of the triangles around a node.
#extension GL_GOOGLE_include_directive : require
#include "triangles.glsl"

layout(local_size_x = linear_group) in;
layout(set = 0, binding = binding_normal, std430) writeonly buffer Normal { vec4 normals[]; };

void main()
{
    uint node = gl_GlobalInvocationID.x;
    if (node >= parameters.node_count) return;
    precise vec3 sum = vec3(0.0f);
    for (uint e = triangle_start[node]; e < triangle_start[node + 1u]; ++e) {
        uvec3 t = triangle_at(node_triangles[e]);
        sum = sum + triangle_normal(position_of(t.x), position_of(t.y), position_of(t.z));
    }
    normals[node] = vec4(direction(sum), 0.0f);
}
