#ifndef SHEET_FORCE_GLSL
#define SHEET_FORCE_GLSL
// The force of a sheet's springs at a node, in the canonical order.
#include "sheet.glsl"

// The state of a nearby node. The including file defines where it is stored.
vec3 near_position(ivec2 place);
vec3 near_velocity(ivec2 place);

precise vec3 springs_force(ivec2 place, vec3 x, vec3 v)
{
    precise vec3 force = vec3(0.0f);
    for (uint n = 0u; n < 12u; ++n) {
        ivec2 other = neighbour_place(place, n);
        if (!on_sheet(other)) continue;
        uint k = sheet_neighbours[n].spring_class;
        force = force + spring_force(x, near_position(other), v, near_velocity(other),
                                     rest_length_of(sheet_neighbours[n].rest), component(parameters.stiffness, k),
                                     component(parameters.spring_damping, k));
    }
    return force;
}
#endif
