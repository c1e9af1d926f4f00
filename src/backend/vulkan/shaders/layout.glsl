#ifndef LAYOUT_GLSL
#define LAYOUT_GLSL
// The memory layout of a cloth that shaders and C++ share: bindings, group sizes, push constants, uniform blocks and rows of
// buffers. Included by cloth.glsl, and by backend/vulkan/layout.hpp, which defines GLSL's type names in C++. Blocks follow
// std140: scalars come in groups of four.

#define UNIFORM_BLOCK(name, number) const int binding_##name = number;
#define STORAGE(name, number) const int binding_##name = number;
#include "bindings.glsl"
#undef UNIFORM_BLOCK
#undef STORAGE

// Group sizes of passes over nodes or springs, over nodes of a sheet, over blocks.
const uint linear_group = 64u, sheet_group_columns = 32u, sheet_group_rows = 4u, block_group = 256u;

// The step of the frame, or the level of the tree, of a call; for a level, where its values begin. For solvers' passes:
// level, detail and guard of Call (solve/pass.hpp), and the sums that the pass writes.
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
    vec4 gravity_direction;    // w: decay factor of velocity per step
    vec4 wind_density;         // m/s; w: kg/m3
    vec4 drag_lift_thickness;  // w unused
    vec4 stiffness;            // N/m by class
    vec4 spring_damping;       // N s/m by class
    vec4 rest_lengths;         // m: along a row, along a column, diagonal, two along a row
    vec4 rest_lengths_more;    // m: two along a column; y: 1/s, of a step; z: `hold` of the hand
    // In the rows of colliders: the first collider, the first target of bodies, and rows of targets per step.
    uint colliders_first, goals_first, goals_stride, grabbed_node;
    vec4 grab_target;  // m; w: 1/s, `pull` of the hand
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
const int most_levels = 32;  // enough for a row of 2^31 nodes
struct SolverBlock
{
    vec4 step_contact;       // s, 1/s, contact stiffness, m (slip)
    vec4 curves[3];          // LimitCurve by class: below, limit, beyond, compressed
    vec4 curve_damping;      // N/m by class; w: m, polish_reach
    vec4 curve_reach;        // by class; w: acad_reach
    vec4 relaxations[2];
    vec4 tolerances;         // of the linear solve, of Newton's method, and its iterations; w: LimitCurve::kept of limits
                             // with memory
    vec4 softest;            // N/m, of limits with memory: by class with compliance; z: of springs to pins on a mesh; w:
                             // without compliance
    vec4 compliance;         // m/N, by class; z: N/m, as softest.z without compliance; w: N/m, the stiffest limit
    vec4 acad_above_below;   // by squared length over squared rest length; z, w: for springs that were constraints
    vec4 acad_near;          // above, below; z: 1 for ACAD, w: 1 if it has memory
    vec4 second_order;       // BDF2: s; 1/s; a third; 1/s, damping by air
    uint has_damping, exact_bend, is_graded, contact_is_by_mass;
    uvec4 has;               // classes of springs that are not off
    uvec4 remembers;         // by class; w: any
    ivec4 curve_kinds;       // by class
    int bottom_base, part_stride, history_plane, padding;
    ivec4 part_counts[4];    // by slot
    LevelNumbers levels[most_levels];
};
#endif
