// Pointers to planes of vectors, for kernels.
#pragma once

#include "backend/cpu/kernels.hpp"
#include "backend/host/planes.hpp"

namespace pliant::cpu {

inline ConstVectors pointers(const Planes<float>& a) { return {a.x.data(), a.y.data(), a.z.data()}; }
inline Vectors pointers(Planes<float>& a) { return {a.x.data(), a.y.data(), a.z.data()}; }

}  // namespace pliant::cpu
