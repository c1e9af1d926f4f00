// What every compute shader sees of a cloth. Bindings are those of cloth_buffers.hpp.
#ifndef CLOTH_GLSL
#define CLOTH_GLSL
#extension GL_GOOGLE_include_directive : require
#include "laws.glsl"

const uint structural = 0u, shear = 1u, bend = 2u;

layout(set = 0, binding = 0, std140) uniform Parameters
{
    uint rows, columns, node_count, spring_count;  // rows, columns: 0 on a mesh
    uint collider_count, colliders_rest, has_air, attached_first;
    vec4 gravity_dt;           // m/s2; w: s
    vec4 gravity_direction;    // w: decay of velocity in a step
    vec4 wind_density;         // m/s; w: kg/m3
    vec4 drag_lift_thickness;  // w unused
    vec4 stiffness;            // N/m by class
    vec4 spring_damping;       // N s/m by class
    vec4 rest_lengths;         // m: along a row, along a column, diagonal, two along a row
    vec4 rest_lengths_more;    // m: two along a column; y: 1/s, of a step; z: how a hand holds
    uvec4 rows_first;          // in collider_rows: of colliders, in rows of 8; of a body's goals, and from step to step;
                               // w: the node that a hand holds
    vec4 grab_target;          // m; w: 1/s, how the hand pulls
} parameters;

// The step of the frame, or the level of the tree, that a call is for; and for a level, where its values lie. Of the
// constraint solver's passes: level, detail and guard of Call (solve/pass.hpp), and the sums that the pass leaves.
layout(push_constant) uniform Push
{
    uint index, source_first, source_count, target_first;
    uint level, detail, guard, slot_first, slot_count;
} push;

layout(set = 0, binding = 1, std430) readonly buffer PositionIn { vec4 position_in[]; };  // w: inverse mass, 1/kg
#ifndef VELOCITY_IN_ACCESS
#define VELOCITY_IN_ACCESS readonly
#endif
layout(set = 0, binding = 2, std430) VELOCITY_IN_ACCESS buffer VelocityIn { vec4 velocity_in[]; };  // w: mass, kg
#ifndef POSITION_OUT_ACCESS
#define POSITION_OUT_ACCESS writeonly
#endif
layout(set = 0, binding = 3, std430) POSITION_OUT_ACCESS buffer PositionOut { vec4 position_out[]; };
#ifndef VELOCITY_OUT_ACCESS
#define VELOCITY_OUT_ACCESS writeonly
#endif
layout(set = 0, binding = 4, std430) VELOCITY_OUT_ACCESS buffer VelocityOut { vec4 velocity_out[]; };

vec3 position_of(uint node) { return position_in[node].xyz; }
vec3 velocity_of(uint node) { return velocity_in[node].xyz; }

float rest_length_of(uint k) { return k < 4u ? parameters.rest_lengths[k] : parameters.rest_lengths_more[k - 4u]; }
float component(vec4 a, uint k) { return a[k]; }
#endif
