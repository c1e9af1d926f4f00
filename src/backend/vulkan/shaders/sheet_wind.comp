#version 460
// Wind on a sheet: each node gathers its up to six triangles, in the order of ClothModel::triangles.
#extension GL_GOOGLE_include_directive : require
#include "sheet.glsl"
#include "wind.glsl"

layout(local_size_x = sheet_group_columns, local_size_y = sheet_group_rows) in;

void main()
{
    ivec2 place = ivec2(gl_GlobalInvocationID.yx);
    if (!on_sheet(place)) return;
    uint columns = parameters.columns, node = node_at(place);
    bool above = place.x > 0, below = place.x + 1 < int(parameters.rows);
    bool left = place.y > 0, right = place.y + 1 < int(columns);
    precise vec3 force = vec3(0.0f);
    if (above && left) force = force + wind_on(node - columns, node - 1u, node);  // the lower triangle of that quad
    if (above && right) {
        force = force + wind_on(node - columns, node, node - columns + 1u);
        force = force + wind_on(node - columns + 1u, node, node + 1u);
    }
    if (below && left) {
        force = force + wind_on(node - 1u, node + columns - 1u, node);
        force = force + wind_on(node, node + columns - 1u, node + columns);
    }
    if (below && right) force = force + wind_on(node, node + columns, node + 1u);
    external_force[node] = vec4(force, 0.0f);
}
