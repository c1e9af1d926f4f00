// 16 lanes; see kernels.inl, and CMakeLists.txt for the flags of this file.
#define PLIANT_PACKS packs_of_avx512
#define PLIANT_LANES 16
#define PLIANT_KERNELS kernels_avx512
#define PLIANT_KERNELS_NAME "avx512"
#include "backend/cpu/kernels.inl"
