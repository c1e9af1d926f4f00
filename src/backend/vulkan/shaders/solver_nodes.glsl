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

#define NODE_PASS(kernel)                                                            \
    void main()                                                                      \
    {                                                                                \
        if (is_skipped()) return;                                                    \
        find_levels();                                                               \
        int row = int(gl_WorkGroupID.y), column = int(gl_GlobalInvocationID.x);      \
        if (column < level.columns) kernel(level_offset(row, column));               \
        leave_sums();                                                                \
    }

#define NUMBERED_NODE_PASS(kernel)                                                                          \
    void main()                                                                                             \
    {                                                                                                       \
        if (is_skipped()) return;                                                                           \
        find_levels();                                                                                      \
        int row = int(gl_WorkGroupID.y), column = int(gl_GlobalInvocationID.x);                             \
        if (column < level.columns) kernel(level_offset(row, column), row * level.columns + column);        \
    }

// Over anything that is numbered through.
#define ROW_PASS(kernel, count)                        \
    void main()                                        \
    {                                                  \
        if (is_skipped()) return;                      \
        find_levels();                                 \
        int number_of = int(gl_GlobalInvocationID.x);  \
        if (number_of < count) kernel(number_of);      \
        leave_sums();                                  \
    }

// Over the nodes of the finer level, on a mesh.
#define FINER_PASS(kernel)                                               \
    void main()                                                          \
    {                                                                    \
        if (is_skipped()) return;                                        \
        find_levels();                                                   \
        int column = int(gl_GlobalInvocationID.x);                       \
        if (column < finer.columns) kernel(finer_offset(0, column));     \
    }

// With the nodes of the finer level that lie at and after those of this one.
#define CELL_PASS(kernel, column_count)                                                          \
    void main()                                                                                  \
    {                                                                                            \
        if (is_skipped()) return;                                                                \
        find_levels();                                                                           \
        int row = int(gl_WorkGroupID.y), column = int(gl_GlobalInvocationID.x);                  \
        if (column < column_count) kernel(level_offset(row, column), finer_offset(2 * row, 2 * column)); \
    }
#endif
