// The numbers of planes and scalars for C++.
#pragma once

namespace pliant {
#include "kernels/planes.kernel.glsl"

/// Number of groups of sum_columns columns, edges or rows.
constexpr int sum_groups(int count) { return (count + sum_columns - 1) / sum_columns; }
}  // namespace pliant
