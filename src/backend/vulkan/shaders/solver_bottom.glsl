#ifndef SOLVER_BOTTOM_GLSL
#define SOLVER_BOTTOM_GLSL
// The dense operator of the coarsest level, which one invocation processes.
#include "solver.glsl"

layout(local_size_x = 1) in;

#define OVER_bottom(kernel)          \
    void main()                      \
    {                                \
        if (is_skipped()) return;    \
        find_levels();               \
        kernel();                    \
    }
#endif
