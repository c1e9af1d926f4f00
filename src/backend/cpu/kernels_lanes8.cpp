// 8 lanes in the baseline instruction set, so that tests cover all widths on every machine; see kernels.inl,
// and CMakeLists.txt for the flags of this file.
#define PLIANT_PACKS packs_of_lanes
#define PLIANT_FUNCTIONS_APART 1
#define PLIANT_LANES 8
#define PLIANT_KERNELS kernels_lanes8
#define PLIANT_KERNELS_NAME "lanes8"
#include "backend/cpu/kernels.inl"
