// What tests of laws share: the number types, and vectors at random.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "laws/laws.hpp"

namespace pliant::test {

using F = Laws<float>;
using D = Laws<double>;
using VF = Vector3<float>;
using VD = Vector3<double>;

inline constexpr double float_rounding = 0x1p-24;

inline VD to_double(VF a) { return {a.x, a.y, a.z}; }
inline double length(VD a) { return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }

class RandomVectors {
public:
    float number(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
    VF vector(float size) { return {number(-size, size), number(-size, size), number(-size, size)}; }

private:
    std::mt19937 engine_{20261122};
};

}  // namespace pliant::test
