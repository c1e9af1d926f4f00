#ifndef SOLVER_SINGLE_GLSL
#define SOLVER_SINGLE_GLSL
// Passes of one invocation. A whole group runs those of serial.kernel.glsl and adds up the parts of a sum together; all
// invocations run the same text, and only the first one writes.
#include "solver.glsl"

layout(local_size_x = sum_lanes) in;
shared real group_sums[gl_WorkGroupSize.x];

real total(int slot)
{
    int lane = int(gl_LocalInvocationIndex), first = slot * solver.part_stride;
    int count = solver.part_counts[slot / 4][slot % 4];
    real sum = 0.0f;
    for (int k = lane; k < count; k += int(gl_WorkGroupSize.x)) sum += parts[first + k];
    group_sums[lane] = sum;
    for (int width = int(gl_WorkGroupSize.x) / 2; width > 0; width /= 2) {
        barrier();
        if (lane < width) group_sums[lane] += group_sums[lane + width];
    }
    barrier();
    sum = group_sums[0];
    barrier();  // the next total may begin
    return sum;
}
void set_scalar(int k, real a)
{
    if (gl_LocalInvocationIndex == 0u) scalars[k] = a;
}

#include "kernels/serial.kernel.glsl"

#define OVER_single(kernel)                                             \
    void main()                                                         \
    {                                                                   \
        bool skipped = is_skipped();                                    \
        barrier(); /* all have seen the guard before the first sets it */ \
        if (skipped) return;                                            \
        kernel();                                                       \
    }
#endif
