#version 460
// Normals of a sheet: Algorithm 5 of the cloth paper, eight triangles in four quadrants.
#extension GL_GOOGLE_include_directive : require
#include "sheet.glsl"

layout(local_size_x = sheet_group_columns, local_size_y = sheet_group_rows) in;
layout(set = 0, binding = binding_normal, std430) writeonly buffer Normal { vec4 normals[]; };

precise vec3 quadrant(ivec2 place, ivec2 first, ivec2 second)
{
    if (!on_sheet(place + first + second)) return vec3(0.0f);
    return quadrant_normal(position_of(node_at(place)), position_of(node_at(place + first)),
                           position_of(node_at(place + first + second)), position_of(node_at(place + second)));
}

void main()
{
    ivec2 place = ivec2(gl_GlobalInvocationID.yx);
    if (!on_sheet(place)) return;
    precise vec3 sum = vec3(0.0f);
    sum = sum + quadrant(place, ivec2(1, 0), ivec2(0, 1));
    sum = sum + quadrant(place, ivec2(0, 1), ivec2(-1, 0));
    sum = sum + quadrant(place, ivec2(-1, 0), ivec2(0, -1));
    sum = sum + quadrant(place, ivec2(0, -1), ivec2(1, 0));
    normals[node_at(place)] = vec4(direction(sum), 0.0f);
}
