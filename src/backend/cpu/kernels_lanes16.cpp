// 16 lanes by what every machine of this architecture has, so that tests see all widths everywhere; see
// kernels.inl, and CMakeLists.txt for the flags of this file.
#define PLIANT_PACKS packs_of_lanes
#define PLIANT_FUNCTIONS_APART 1
#define PLIANT_LANES 16
#define PLIANT_KERNELS kernels_lanes16
#define PLIANT_KERNELS_NAME "lanes16"
#include "backend/cpu/kernels.inl"
