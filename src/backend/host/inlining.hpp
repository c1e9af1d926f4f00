// Inlining of kernel functions: everything inlined, which is fast; or separate functions, for kernels that
// only tests run and that must compile quickly.
#pragma once

/// Set by the file that includes kernels.inl.
#if !defined(PLIANT_FUNCTIONS_APART)
#define PLIANT_FUNCTIONS_APART 0
#endif

/// For functions of a few instructions, which are always inlined.
#define PLIANT_SMALL __attribute__((always_inline))
#if PLIANT_FUNCTIONS_APART
#define PLIANT_INLINE inline
#define PLIANT_IN_ONE_PIECE
#else
#define PLIANT_INLINE inline __attribute__((always_inline))
#define PLIANT_IN_ONE_PIECE __attribute__((flatten))  // of a kernel: inlines all that it calls
#endif
