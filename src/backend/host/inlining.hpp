// How functions of kernels come together: in one piece, which is fast; or each by itself, for kernels that
// only tests run and that must compile fast.
#pragma once

/// Set by the file that includes kernels.inl.
#if !defined(PLIANT_FUNCTIONS_APART)
#define PLIANT_FUNCTIONS_APART 0
#endif

/// Of what is a few instructions: in one piece with its caller in either case.
#define PLIANT_SMALL __attribute__((always_inline))
#if PLIANT_FUNCTIONS_APART
#define PLIANT_INLINE inline
#define PLIANT_IN_ONE_PIECE
#else
#define PLIANT_INLINE inline __attribute__((always_inline))
#define PLIANT_IN_ONE_PIECE __attribute__((flatten))  // of a kernel: with all that it calls
#endif
