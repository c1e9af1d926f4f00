// 8 lanes, with the machine's estimate of inverse square roots and fused multiply-add (CMakeLists.txt).
#define PLIANT_PACKS packs_of_avx2_fast
#define PLIANT_FAST_MATH 1
#define PLIANT_LANES 8
#define PLIANT_KERNELS kernels_avx2_fast
#define PLIANT_KERNELS_NAME "avx2, fast math"
#include "backend/cpu/kernels.inl"
