#version 460
// The largest strain of the structural and shear springs at each node of a sheet, for colouring.
#extension GL_GOOGLE_include_directive : require
#include "sheet.glsl"

layout(local_size_x = sheet_group_columns, local_size_y = sheet_group_rows) in;
layout(set = 0, binding = binding_strain, std430) writeonly buffer Strain { float strains[]; };

void main()
{
    ivec2 place = ivec2(gl_GlobalInvocationID.yx);
    if (!on_sheet(place)) return;
    uint node = node_at(place);
    precise float most = -1.0f;
    for (uint n = 0u; n < 12u; ++n) {
        ivec2 other = neighbour_place(place, n);
        if (!on_sheet(other) || sheet_neighbours[n].spring_class == bend) continue;
        most = largest(spring_stretch(position_of(node), position_of(node_at(other)),
                                      rest_length_of(sheet_neighbours[n].rest)), most);
    }
    strains[node] = most;
}
