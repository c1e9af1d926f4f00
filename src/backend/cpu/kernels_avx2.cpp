// 8 lanes; see kernels.inl, and CMakeLists.txt for the flags of this file.
#define PLIANT_PACKS packs_of_avx2
#define PLIANT_LANES 8
#define PLIANT_KERNELS kernels_avx2
#define PLIANT_KERNELS_NAME "avx2"
#include "backend/cpu/kernels.inl"
