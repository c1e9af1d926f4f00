#version 460
// One step of a sheet, node-centric: forces of up to 12 springs, integration and contact in one pass.
#extension GL_GOOGLE_include_directive : require
#include "sheet_force.glsl"
#include "step.glsl"

layout(local_size_x = sheet_group_columns, local_size_y = sheet_group_rows) in;

vec3 near_position(ivec2 place) { return position_of(node_at(place)); }
vec3 near_velocity(ivec2 place) { return velocity_of(node_at(place)); }

void main()
{
    ivec2 place = ivec2(gl_GlobalInvocationID.yx);
    if (!on_sheet(place)) return;
    uint node = node_at(place);
    finish_step(node, springs_force(place, position_of(node), velocity_of(node)));
}
