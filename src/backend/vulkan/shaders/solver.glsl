#ifndef SOLVER_GLSL
#define SOLVER_GLSL
// The functions that src/kernels calls, as GLSL; SolverKernels (backend/host/solver_kernels.hpp) defines them in C++. All
// numbers of a cloth's solver are in one buffer, the arena; the levels of its hierarchy have the offsets.
#define POSITION_OUT_ACCESS  // the next state has the positions to which pins move
#include "colliders.glsl"
#define KERNEL
#define UNROLL  // empty: drivers decide themselves, and forced unrolling takes llvmpipe seconds to compile
#include "kernels/planes.kernel.glsl"

layout(set = 0, binding = binding_solver, std140) uniform SolverOfCloth { SolverBlock solver; };
layout(set = 0, binding = binding_external_force, std430) readonly buffer ExternalForce { vec4 external_force[]; };
layout(set = 0, binding = binding_solver_arena, std430) buffer Arena { float arena[]; };
layout(set = 0, binding = binding_solver_scalars, std430) buffer Scalars { float scalars[]; };
layout(set = 0, binding = binding_solver_parts, std430) buffer Parts { float parts[]; };
layout(set = 0, binding = binding_solver_topology, std430) readonly buffer Topology { int topology_entries[]; };
layout(set = 0, binding = binding_multiplier, std430) writeonly buffer Multiplier { float multiplier[]; };  // N, by node

LevelNumbers level, finer;
real sums[3] = real[3](0.0f, 0.0f, 0.0f);

// Uniform over all invocations of a dispatch.
bool is_skipped() { return push.guard != uint(scalar_count) && scalars[push.guard] != 0.0f; }
void find_levels()
{
    level = solver.levels[push.level];
    finer = solver.levels[push.level > 0u ? push.level - 1u : 0u];
}

real multiply_add(real a, real b, real c) { return a * b + c; }  // rounded twice, as on the host
#include "kernels/block.kernel.glsl"

int at(int plane, int o) { return level.base + plane * level.size + o; }
int finer_at(int plane, int o) { return finer.base + plane * finer.size + o; }
real load(int plane, int o) { return arena[at(plane, o)]; }
void store(int plane, int o, real a) { arena[at(plane, o)] = a; }
vec3 load3(int plane, int o) { return vec3(load(plane, o), load(plane + 1, o), load(plane + 2, o)); }
void store3(int plane, int o, vec3 a)
{
    store(plane, o, a.x);
    store(plane + 1, o, a.y);
    store(plane + 2, o, a.z);
}
Symmetric load6(int plane, int o)
{
    return Symmetric(load(plane, o), load(plane + 1, o), load(plane + 2, o), load(plane + 3, o), load(plane + 4, o),
                     load(plane + 5, o));
}
Symmetric load6_anywhere(int plane, int o) { return load6(plane, o); }  // same here; on the host a pack must not cross
                                                                        // groups
void store6(int plane, int o, Symmetric a)
{
    store(plane, o, a.xx);
    store(plane + 1, o, a.xy);
    store(plane + 2, o, a.xz);
    store(plane + 3, o, a.yy);
    store(plane + 4, o, a.yz);
    store(plane + 5, o, a.zz);
}
real finer_load(int plane, int o) { return arena[finer_at(plane, o)]; }
vec3 finer_load3(int plane, int o)
{
    return vec3(finer_load(plane, o), finer_load(plane + 1, o), finer_load(plane + 2, o));
}
Symmetric finer_load6(int plane, int o)
{
    return Symmetric(finer_load(plane, o), finer_load(plane + 1, o), finer_load(plane + 2, o), finer_load(plane + 3, o),
                     finer_load(plane + 4, o), finer_load(plane + 5, o));
}
void finer_add(int plane, int o, vec3 a)
{
    if (!(finer_load(plane_factor, o) > 0.0f)) return;
    for (int k = 0; k < 3; ++k) arena[finer_at(plane + k, o)] += a[k];
}
void finer_add3(int plane, int o, vec3 even, vec3 odd)
{
    finer_add(plane, o, even);
    finer_add(plane, o + 1, odd);
}
void finer_store3(int plane, int o, vec3 a)
{
    for (int k = 0; k < 3; ++k) arena[finer_at(plane + k, o)] = a[k];
}
int finer_coupling(int k)
{
    bool folded = push.level == 1u && solver.exact_bend != 0u && (k == 0 || k == 2);
    return folded ? plane_fold + 3 * k : plane_block + 6 * k;
}

int source_plane() { return push.detail % 2u == 0u ? plane_correction : plane_correction_2; }
int target_plane() { return push.detail % 2u == 0u ? plane_correction_2 : plane_correction; }
int finer_plane() { return push.detail / 2u % 2u == 0u ? plane_correction : plane_correction_2; }
real relaxation() { return solver.relaxations[push.detail / 8u][push.detail / 2u % 4u]; }
real scalar(int k) { return scalars[k]; }

int sheet_class(int k) { return k >= 4 ? 2 : k % 2; }
bool sheet_has(int k) { return solver.has[sheet_class(k)] != 0u; }
LimitCurve class_curve(int k)
{
    vec4 c = solver.curves[k];
    return LimitCurve(solver.curve_kinds[k], c.x, c.y, c.z, c.w, solver.curve_damping[k], 0.0f, solver.curve_reach[k],
                      solver.remembers[k] != 0u ? solver.tolerances.w : 1.0f);
}
LimitCurve sheet_curve(int k) { return class_curve(sheet_class(k)); }
real sheet_rest(int k)
{
    return rest_length_of(k == 0 ? 0u : k == 2 ? 1u : k < 4 ? 2u : k == 4 ? 3u : 4u);
}
bool has_damping() { return solver.has_damping != 0u; }
bool is_graded() { return solver.is_graded != 0u; }
bool has_bend() { return solver.has[bend] != 0u; }
bool exact_bend() { return push.level == 0u && solver.exact_bend != 0u && solver.has[bend] != 0u; }
real contact_stiffness() { return solver.step_contact.z; }
bool contact_is_by_mass() { return solver.contact_is_by_mass != 0u; }
real slip() { return solver.step_contact.w; }
real thickness() { return parameters.drag_lift_thickness.z; }
real decay() { return parameters.gravity_direction.w; }
real step_length() { return solver.step_contact.x; }
real inverse_step() { return solver.step_contact.y; }
bool is_second_order() { return solver.history_plane > 0; }
int history_plane() { return solver.history_plane; }
real short_step() { return solver.second_order.x; }
real inverse_short_step() { return solver.second_order.y; }
real third() { return solver.second_order.z; }
real air() { return solver.second_order.w; }
vec3 gravity() { return parameters.gravity_dt.xyz; }
vec3 hand_target() { return parameters.grab_target.xyz; }
real hand_pull() { return parameters.grab_target.w; }
real hand_hold() { return parameters.rest_lengths_more.z; }
real linear_tolerance() { return solver.tolerances.x; }
real newton_tolerance() { return solver.tolerances.y; }
real enough_iterations() { return solver.tolerances.z; }
bool remembers(int k) { return solver.remembers[k] != 0u; }
bool remembers_any() { return solver.remembers.w != 0u; }
real softest(int k) { return solver.softest[k]; }
real softest_of_edge(int e, int k) { return e >= level.held && e < level.loose ? solver.softest.z : softest(k); }
real bare_softest_of_edge(int e) { return e >= level.held && e < level.loose ? solver.compliance.z : solver.softest.w; }
real softest_limit() { return solver.softest.w; }
real compliance(int k) { return solver.compliance[k]; }
real polish_reach() { return solver.curve_damping.w; }
real stiffest_limit() { return solver.compliance.w; }

bool is_last_look() { return push.detail == uint(detail_last_look); }
bool is_cloth() { return push.level == 0u; }
bool is_acad() { return solver.acad_near.z != 0.0f; }
bool acad_has_memory() { return solver.acad_near.w != 0.0f; }
bool acad_has_compression() { return solver.acad_above_below.y > 0.0f; }
real acad_above2() { return solver.acad_above_below.x; }
real acad_below2() { return solver.acad_above_below.y; }
real acad_held_above2() { return solver.acad_above_below.z; }
real acad_held_below2() { return solver.acad_above_below.w; }
real acad_near_above2() { return solver.acad_near.x; }
real acad_near_below2() { return solver.acad_near.y; }
real acad_reach() { return solver.curve_reach.w; }

int collider_count() { return int(parameters.collider_count); }
Collider collider(int k) { return collider_at(push.index, uint(k)); }

// Rows and columns as in NodeLayout (body/node_layout.hpp).
int level_offset(int row, int column) { return (row + border_rows) * level.stride + row_pad + column; }
int finer_offset(int row, int column) { return (row + border_rows) * finer.stride + row_pad + column; }
int node_at(int o) { return ((o - row_pad) / level.stride - border_rows) * level.columns + (o - row_pad) % level.stride; }
vec3 node_position(int o) { return position_in[node_at(o)].xyz; }
vec3 node_velocity(int o) { return velocity_in[node_at(o)].xyz; }
// Beyond the border no spring reaches, so any node is valid.
vec3 node_next_position(int o) { return position_out[min(uint(node_at(o)), parameters.node_count - 1u)].xyz; }
vec3 node_next_velocity(int o) { return velocity_out[node_at(o)].xyz; }
void set_multiplier(int o, real a) { multiplier[node_at(o)] = a; }
vec3 node_force(int o) { return parameters.has_air != 0u ? external_force[node_at(o)].xyz : vec3(0.0f); }
real node_inverse_mass(int o) { return position_in[node_at(o)].w; }
bool hand_is_near(int o) { return uint(node_at(o)) == parameters.grabbed_node && hand_hold() > 0.0f; }
vec3 where_held(int o, vec3 held, vec3 otherwise) { return held; }  // the one lane is known to be near
real node_mass(int o) { return velocity_in[node_at(o)].w; }
void node_end(int o, vec3 x, vec3 v)
{
    position_out[node_at(o)].xyz = x;  // leaves the mass in w, which is in both copies
    velocity_out[node_at(o)].xyz = v;
}

// Invocations never process padding, nor a node twice.
mask inside_level() { return true; }

// Data by edge of a mesh, and by spring in the paper's solver.
int topology(int k) { return topology_entries[k]; }
real topology_weight(int k) { return intBitsToFloat(topology(k)); }
real number(int k) { return arena[k]; }
void set_number(int k, real a) { arena[k] = a; }
int whole(real a) { return int(a); }
real part_of_sum(int slot, int k) { return parts[slot * solver.part_stride + k]; }
int scan_level() { return int(push.detail); }
int edge_at(int plane, int numbers, int e) { return level.edge_base + plane * level.edge_size + numbers * e; }
real edge_load(int plane, int e) { return arena[edge_at(plane, 1, e)]; }
void edge_store(int plane, int e, real a) { arena[edge_at(plane, 1, e)] = a; }
vec3 edge_load3(int plane, int e)
{
    int p = edge_at(plane, 3, e);
    return vec3(arena[p], arena[p + 1], arena[p + 2]);
}
void edge_store3(int plane, int e, vec3 a)
{
    int p = edge_at(plane, 3, e);
    for (int k = 0; k < 3; ++k) arena[p + k] = a[k];
}
Symmetric six_numbers(int p)
{
    return Symmetric(arena[p], arena[p + 1], arena[p + 2], arena[p + 3], arena[p + 4], arena[p + 5]);
}
Symmetric edge_load6(int plane, int e) { return six_numbers(edge_at(plane, 6, e)); }
Symmetric finer_edge_load6(int plane, int e) { return six_numbers(finer.edge_base + plane * finer.edge_size + 6 * e); }
void edge_store6(int plane, int e, Symmetric a)
{
    int p = edge_at(plane, 6, e);
    arena[p] = a.xx;
    arena[p + 1] = a.xy;
    arena[p + 2] = a.xz;
    arena[p + 3] = a.yy;
    arena[p + 4] = a.yz;
    arena[p + 5] = a.zz;
}

// The dense operator of the coarsest level.
int bottom_nodes() { return level.rows * level.columns; }
real bottom_get(int k) { return arena[solver.bottom_base + k]; }
void bottom_set(int k, real a) { arena[solver.bottom_base + k] = a; }
int bottom_at(int plane, int k)
{
    int node = k / 3;
    return at(plane + k % 3, level_offset(node / level.columns, node % level.columns));
}
real bottom_vector(int plane, int k) { return arena[bottom_at(plane, k)]; }
void bottom_set_vector(int plane, int k, real a) { arena[bottom_at(plane, k)] = a; }

// Only for single passes (solver_single.glsl).
real total(int slot);
void set_scalar(int k, real a);

void bottom_assemble();
#include "kernels/newton.kernel.glsl"
#include "kernels/bottom.kernel.glsl"
#include "kernels/sheet.kernel.glsl"
#include "kernels/acad.kernel.glsl"
#include "kernels/linear.kernel.glsl"
#endif
