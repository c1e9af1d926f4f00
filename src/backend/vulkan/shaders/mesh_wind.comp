#version 460
// Wind on a mesh: each node gathers its triangles.
#extension GL_GOOGLE_include_directive : require
#include "triangles.glsl"
#include "wind.glsl"

layout(local_size_x = linear_group) in;

void main()
{
    uint node = gl_GlobalInvocationID.x;
    if (node >= parameters.node_count) return;
    precise vec3 force = vec3(0.0f);
    for (uint e = triangle_start[node]; e < triangle_start[node + 1u]; ++e) {
        uvec3 t = triangle_at(node_triangles[e]);
        force = force + wind_on(t.x, t.y, t.z);
    }
    external_force[node] = vec4(force, 0.0f);
}
