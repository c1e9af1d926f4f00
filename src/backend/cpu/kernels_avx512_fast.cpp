// 16 lanes, with the machine's estimate of inverse square roots and fused multiply-add (CMakeLists.txt).
#define PLIANT_PACKS packs_of_avx512_fast
#define PLIANT_FAST_MATH 1
#define PLIANT_LANES 16
#define PLIANT_KERNELS kernels_avx512_fast
#define PLIANT_KERNELS_NAME "avx512, fast math"
#include "backend/cpu/kernels.inl"
