#version 460
// One step of a sheet, node-centric: forces of up to 12 springs, integration and contact in one pass.
#extension GL_GOOGLE_include_directive : require
#include "sheet.glsl"
#include "step.glsl"

layout(local_size_x = 32, local_size_y = 4) in;

void main()
{
    ivec2 place = ivec2(gl_GlobalInvocationID.yx);
    if (!on_sheet(place)) return;
    uint node = node_at(place);
    vec3 x = position_of(node), v = velocity_of(node);
    precise vec3 force = vec3(0.0f);
    for (uint n = 0u; n < 12u; ++n) {
        ivec2 other_place = neighbour_place(place, n);
        if (!on_sheet(other_place)) continue;
        uint other = node_at(other_place), k = sheet_neighbours[n].spring_class;
        force = force + spring_force(x, position_of(other), v, velocity_of(other), rest_length_of(sheet_neighbours[n].rest),
                                     component(parameters.stiffness, k), component(parameters.spring_damping, k));
    }
    finish_step(node, force);
}
