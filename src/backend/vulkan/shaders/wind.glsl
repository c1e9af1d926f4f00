#ifndef WIND_GLSL
#define WIND_GLSL
// Wind force of a triangle on one of its corners.
#include "cloth.glsl"

layout(set = 0, binding = binding_external_force, std430) writeonly buffer ExternalForce { vec4 external_force[]; };

precise vec3 wind_on(uint i, uint j, uint k)
{
    return wind_force(position_of(i), position_of(j), position_of(k), velocity_of(i), velocity_of(j), velocity_of(k),
                      parameters.wind_density.xyz, parameters.wind_density.w, parameters.drag_lift_thickness.x,
                      parameters.drag_lift_thickness.y);
}
#endif
