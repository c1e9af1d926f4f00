// The numbers of planes and scalars, as C++.
#pragma once

namespace pliant {
#include "kernels/planes.kernel.glsl"

/// Groups of sum_columns that so many columns, edges or rows make.
constexpr int sum_groups(int count) { return (count + sum_columns - 1) / sum_columns; }
}  // namespace pliant
