// The numbers of planes and scalars, as C++.
#pragma once

namespace pliant {
#include "kernels/planes.kernel.glsl"
}  // namespace pliant
