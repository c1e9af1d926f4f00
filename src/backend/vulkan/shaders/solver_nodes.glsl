#ifndef SOLVER_NODES_GLSL
#define SOLVER_NODES_GLSL
// Passes over the nodes of a level: a group takes 64 columns of a row, and adds up what they leave in `sums`.
#include "solver.glsl"

layout(local_size_x = 64) in;
shared real group_sums[gl_WorkGroupSize.x];

// Nobody reads sums over coarser levels.
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

// Of ACAD's solve: the flag of a row or group (kernels/acad.kernel.glsl).
bool is_live(int flag) { return !is_acad() || number(flag) > 0.0f; }
bool is_live_node(SolverLevel of, int row, int column)
{
    return is_live(of.live + (of.rows > 1 ? row : column / sum_columns));
}

#define NODE_PASS_WHERE(kernel, condition)                                           \
    void main()                                                                      \
    {                                                                                \
        if (is_skipped()) return;                                                    \
        find_levels();                                                               \
        int row = int(gl_WorkGroupID.y), column = int(gl_GlobalInvocationID.x);      \
        if (column < level.columns && (condition)) kernel(level_offset(row, column)); \
        leave_sums();                                                                \
    }
#define NODE_PASS(kernel) NODE_PASS_WHERE(kernel, true)
#define LIVE_NODE_PASS(kernel) NODE_PASS_WHERE(kernel, is_live_node(level, row, column))

#define NUMBERED_NODE_PASS(kernel)                                                                          \
    void main()                                                                                             \
    {                                                                                                       \
        if (is_skipped()) return;                                                                           \
        find_levels();                                                                                      \
        int row = int(gl_WorkGroupID.y), column = int(gl_GlobalInvocationID.x);                             \
        if (column < level.columns) kernel(level_offset(row, column), row * level.columns + column);        \
    }

// Over anything that is numbered through.
#define ROW_PASS_WHERE(kernel, count, condition)                       \
    void main()                                                        \
    {                                                                  \
        if (is_skipped()) return;                                      \
        find_levels();                                                 \
        int number_of = int(gl_GlobalInvocationID.x);                  \
        if (number_of < count && (condition)) kernel(number_of);       \
        leave_sums();                                                  \
    }
#define ROW_PASS(kernel, count) ROW_PASS_WHERE(kernel, count, true)
#define LIVE_EDGE_PASS(kernel) \
    ROW_PASS_WHERE(kernel, level.edges, is_live(level.live_edges + number_of / sum_columns))

// Over the nodes of the finer level, on a mesh.
#define FINER_PASS(kernel)                                               \
    void main()                                                          \
    {                                                                    \
        if (is_skipped()) return;                                        \
        find_levels();                                                   \
        int column = int(gl_GlobalInvocationID.x);                       \
        if (column < finer.columns && is_live_node(finer, 0, column)) kernel(finer_offset(0, column)); \
    }

// With the nodes of the finer level that lie at and after those of this one.
#define CELL_PASS(kernel, column_count)                                                          \
    void main()                                                                                  \
    {                                                                                            \
        if (is_skipped()) return;                                                                \
        find_levels();                                                                           \
        int row = int(gl_WorkGroupID.y), column = int(gl_GlobalInvocationID.x);                  \
        if (column < column_count && is_live_node(level, row, column))                           \
            kernel(level_offset(row, column), finer_offset(2 * row, 2 * column));                \
    }
#endif
