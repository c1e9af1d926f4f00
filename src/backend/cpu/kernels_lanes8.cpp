// 8 lanes by what every machine of this architecture has, so that tests see all widths everywhere; see
// kernels.inl, and CMakeLists.txt for the flags of this file.
#define PLIANT_PACKS packs_of_lanes
#define PLIANT_FUNCTIONS_APART 1
#define PLIANT_LANES 8
#define PLIANT_KERNELS kernels_lanes8
#define PLIANT_KERNELS_NAME "lanes8"
#include "backend/cpu/kernels.inl"
