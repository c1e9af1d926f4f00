#ifndef SOLVER_NODES_GLSL
#define SOLVER_NODES_GLSL
// Passes over the nodes of a level: a group processes 64 columns of a row and adds up their `sums`.
#include "solver.glsl"

layout(local_size_x = sum_columns) in;
shared real group_sums[gl_WorkGroupSize.x];

// Sums over coarser levels are not used.
void leave_sums()
{
    if (push.level != 0u) return;
    uint lane = gl_LocalInvocationIndex, group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    for (uint k = 0u; k < push.slot_count; ++k) {
        group_sums[lane] = sums[k];
        for (uint width = gl_WorkGroupSize.x / 2u; width > 0u; width /= 2u) {
            barrier();
            if (lane < width) group_sums[lane] += group_sums[lane + width];
        }
        if (lane == 0u) parts[(push.slot_first + k) * uint(solver.part_stride) + group] = group_sums[0];
        barrier();
    }
}

// ACAD's solve: the flag of a row or group (kernels/acad.kernel.glsl).
bool is_live(int flag) { return !is_acad() || number(flag) > 0.0f; }
bool is_live_node(LevelNumbers of, int row, int column)
{
    return is_live(of.live + (of.rows > 1 ? row : column / sum_columns));
}

// Loops over units (PassUnit of solve/pass.hpp); each shader uses one.
#define OVER_NODES(call, condition)                                             \
    void main()                                                                 \
    {                                                                           \
        if (is_skipped()) return;                                               \
        find_levels();                                                          \
        int row = int(gl_WorkGroupID.y), column = int(gl_GlobalInvocationID.x); \
        if (column < level.columns && (condition)) call;                        \
        leave_sums();                                                           \
    }
#define OVER_level_node(kernel) OVER_NODES(kernel(level_offset(row, column)), true)
#define OVER_live_node(kernel) OVER_NODES(kernel(level_offset(row, column)), is_live_node(level, row, column))
#define OVER_numbered_node(kernel) OVER_NODES(kernel(level_offset(row, column), row * level.columns + column), true)

#define OVER_NUMBERS(kernel, count, condition)                  \
    void main()                                                 \
    {                                                           \
        if (is_skipped()) return;                               \
        find_levels();                                          \
        int number_of = int(gl_GlobalInvocationID.x);           \
        if (number_of < (count) && (condition)) kernel(number_of); \
        leave_sums();                                           \
    }
#define OVER_edge(kernel) OVER_NUMBERS(kernel, level.edges, true)
#define OVER_live_edge(kernel) \
    OVER_NUMBERS(kernel, level.edges, is_live(level.live_edges + number_of / sum_columns))
#define OVER_spring_row(kernel) OVER_NUMBERS(kernel, topology(rows_springs), true)
#define OVER_constraint_row(kernel) OVER_NUMBERS(kernel, topology(rows_constraints), true)
#define OVER_active_row(kernel) OVER_NUMBERS(kernel, whole(scalar(scalar_rows)), true)
#define OVER_row_block(kernel) OVER_NUMBERS(kernel, groups_of(topology(rows_scan + 2 * scan_level() + 1), scan_block), true)
#define OVER_flag(kernel) OVER_NUMBERS(kernel, flag_count(), true)

int groups_of(int count, int size) { return (count + size - 1) / size; }
// As SolverLevel::node_units, plus groups of edges.
int flag_count()
{
    int node_units = level.rows > 1 ? level.rows : groups_of(level.columns, sum_columns);
    return max(node_units, groups_of(level.edges, sum_columns));
}

#define OVER_live_finer_node(kernel)                                                                   \
    void main()                                                                                        \
    {                                                                                                  \
        if (is_skipped()) return;                                                                      \
        find_levels();                                                                                 \
        int column = int(gl_GlobalInvocationID.x);                                                     \
        if (column < finer.columns && is_live_node(finer, 0, column)) kernel(finer_offset(0, column)); \
    }

#define OVER_CELLS(kernel, column_count)                                                \
    void main()                                                                         \
    {                                                                                   \
        if (is_skipped()) return;                                                       \
        find_levels();                                                                  \
        int row = int(gl_WorkGroupID.y), column = int(gl_GlobalInvocationID.x);         \
        if (column < (column_count) && is_live_node(level, row, column))                \
            kernel(level_offset(row, column), finer_offset(2 * row, 2 * column));       \
    }
#define OVER_live_cell(kernel) OVER_CELLS(kernel, level.columns)
#define OVER_live_finer_cell(kernel) OVER_CELLS(kernel, (finer.columns + 1) / 2)
#endif
