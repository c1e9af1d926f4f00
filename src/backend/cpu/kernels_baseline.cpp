// 4 lanes; see kernels.inl, and CMakeLists.txt for the flags of this file.
#define PLIANT_LANES 4
#define PLIANT_KERNELS kernels_baseline
// The baseline instruction set of the architecture.
#if defined(__x86_64__)
#define PLIANT_KERNELS_NAME "sse2"
#elif defined(__aarch64__)
#define PLIANT_KERNELS_NAME "neon"
#else
#define PLIANT_KERNELS_NAME "generic"
#endif
#include "backend/cpu/kernels.inl"
