#ifndef LAYOUT_GLSL
#define LAYOUT_GLSL
// What shaders and C++ share of a cloth's memory on a device: bindings, groups, push constants, uniform blocks and rows of
// buffers. Included by cloth.glsl, and by backend/vulkan/layout.hpp, which gives C++ the names of GLSL's types. Blocks obey
// std140: what is no vector comes in groups of four.

#define UNIFORM_BLOCK(name, number) const int binding_##name = number;
#define STORAGE(name, number) const int binding_##name = number;
#include "bindings.glsl"
#undef UNIFORM_BLOCK
#undef STORAGE

// Invocations of a group: of passes over nodes or springs, over nodes of a sheet, over blocks.
const uint linear_group = 64u, sheet_group_columns = 32u, sheet_group_rows = 4u, block_group = 256u;

// The step of the frame, or the level of the tree, that a call is for; and for a level, where its values lie. Of the
// solvers' passes: level, detail and guard of Call (solve/pass.hpp), and the sums that the pass leaves.
struct Push
{
    uint index, source_first, source_count, target_first;
    uint level, detail, guard, slot_first, slot_count;
};

struct Parameters
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
    // In the rows of colliders: the first collider, the first goal of bodies, and from step to step.
    uint colliders_first, goals_first, goals_stride, grabbed_node;
    vec4 grab_target;  // m; w: 1/s, how the hand pulls
};

// A collider, as rows of four floats (PlacedCollider of body/collider_motion.hpp).
struct ColliderRows
{
    vec4 centre_kind;  // m
    vec4 axis_x_radius, axis_y_friction, axis_z_response;
    vec4 half_size;      // m
    vec4 velocity, spin;  // m/s, 1/s
    vec4 unused;
};
const uint rows_of_collider = 8u;

// Constants of a cloth's solver (SolverConstants of backend/host/solver_context.hpp).
const int most_levels = 32;  // more halvings than a row of 2^31 nodes allows
struct SolverBlock
{
    vec4 step_contact;       // s, 1/s, contact stiffness, m (slip)
    vec4 curves[3];          // LimitCurve by class: below, limit, beyond, compressed
    vec4 curve_damping;      // N/m by class; w: m, polish_reach
    vec4 curve_reach;        // by class; w: acad_reach
    vec4 relaxations[2];
    vec4 tolerances;         // of the linear solve, of Newton's method, and its iterations; w: LimitCurve::kept of
                             // limits that remember
    vec4 softest;            // N/m, of limits that remember: by class with their compliance; z: that hold a node of a
                             // mesh; w: without compliance
    vec4 compliance;         // m/N, by class; z: N/m, as softest.z without compliance; w: N/m, the stiffest limit, too
    vec4 acad_above_below;   // by length squared over rest length squared; z, w: of those held
    vec4 acad_near;          // above, below; z: is it ACAD, w: does it remember
    vec4 second_order;       // s, of BDF2; 1/s; a third; 1/s, what air takes
    uint has_damping, exact_bend, is_graded, contact_is_by_mass;
    uvec4 has;               // classes of springs
    uvec4 remembers;         // by class; w: any
    ivec4 curve_kinds;       // by class
    int bottom_base, part_stride, history_plane, padding;
    ivec4 part_counts[4];    // by slot
    LevelNumbers levels[most_levels];
};
#endif
