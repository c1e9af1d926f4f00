#version 460
// Measures of a sheet's nodes, each with its forward springs, merged per block of 256.
#extension GL_GOOGLE_include_directive : require
#include "sheet.glsl"
#include "measure_node.glsl"

layout(local_size_x = block_group) in;

void main()
{
    uint node = gl_GlobalInvocationID.x;
    Measure m = measure_of_nothing();
    if (node < parameters.node_count) {
        ivec2 place = ivec2(node / parameters.columns, node % parameters.columns);
        for (uint n = 6u; n < 12u; ++n) {
            ivec2 other = neighbour_place(place, n);
            if (!on_sheet(other)) continue;
            uint k = sheet_neighbours[n].spring_class;
            m = measure_spring(m, position_of(node), position_of(node_at(other)), rest_length_of(sheet_neighbours[n].rest),
                               component(parameters.stiffness, k), k != bend);
        }
        m = with_node(m, node);
    }
    merge_block(m, gl_WorkGroupID.x);
}
