#version 460
// The largest strain of the structural and shear springs at each node, for colouring.
#extension GL_GOOGLE_include_directive : require
#include "list.glsl"

layout(local_size_x = linear_group) in;
layout(set = 0, binding = binding_strain, std430) writeonly buffer Strain { float strains[]; };

void main()
{
    uint node = gl_GlobalInvocationID.x;
    if (node >= parameters.node_count) return;
    precise float most = -1.0f;
    for (uint e = neighbour_start[node]; e < neighbour_start[node + 1u]; ++e) {
        uint other = neighbours[e].x, spring = neighbours[e].y;
        if (spring_class_of(spring) == bend) continue;
        most = largest(spring_stretch(position_of(node), position_of(other), spring_rest_of(spring)), most);
    }
    strains[node] = most;
}
