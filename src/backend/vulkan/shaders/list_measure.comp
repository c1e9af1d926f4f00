#version 460
// Measures of nodes, each with its springs to nodes of higher index, merged per block of 256.
#extension GL_GOOGLE_include_directive : require
#include "list.glsl"
#include "measure_node.glsl"

layout(local_size_x = block_group) in;

void main()
{
    uint node = gl_GlobalInvocationID.x;
    Measure m = measure_of_nothing();
    if (node < parameters.node_count) {
        for (uint e = neighbour_start[node]; e < neighbour_start[node + 1u]; ++e) {
            uint other = neighbours[e].x, spring = neighbours[e].y, k = spring_class_of(spring);
            if (other < node) continue;
            precise float stiffness = component(parameters.stiffness, k) * spring_scale_of(spring);
            m = measure_spring(m, position_of(node), position_of(other), spring_rest_of(spring), stiffness, k != bend);
            precise float bent = bending_energy(position_of(node), position_of(other), spring_bending_of(spring));
            precise float energy = m.elastic_energy + bent;
            m.elastic_energy = energy;
        }
        m = with_node(m, node);
    }
    merge_block(m, gl_WorkGroupID.x);
}
