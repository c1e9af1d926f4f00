// The laws as C++, from the same text that the shaders compile, once for each number type T.
//   Laws<double>     the oracle
//   Laws<float>      one node at a time
//   Laws<Pack<W>>    W nodes at a time (src/backend/cpu/pack.hpp)
// T needs the operators + - (unary and binary) * < > >= and, through NumberTraits<T>, a choice, a seed for
// the inverse square root and a test for finiteness. Compile with -ffp-contract=off: contraction would change
// bits.
#pragma once

#include <bit>
#include <cstdint>

namespace pliant {

template <class T>
struct Vector3 {
    T x, y, z;
    Vector3() = default;
    Vector3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
    friend Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vector3 operator*(Vector3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
};

template <class T>
struct Vector4 {
    T x, y, z, w;
    Vector4() = default;
    Vector4(Vector3<T> a, T w_) : x(a.x), y(a.y), z(a.z), w(w_) {}
};

template <class T>
struct NumberTraits;

template <>
struct NumberTraits<float> {
    static constexpr int inverse_sqrt_steps = 3;
    static float inverse_sqrt_seed(float a)
    {
        return std::bit_cast<float>(0x5f375a86u - (std::bit_cast<std::uint32_t>(a) >> 1));
    }
    static float choose(bool m, float a, float b) { return m ? a : b; }
    static bool is_finite(float a) { return (std::bit_cast<std::uint32_t>(a) & 0x7f800000u) != 0x7f800000u; }
    static bool both(bool a, bool b) { return a && b; }
    static bool any_lane(bool a) { return a; }
};

template <>
struct NumberTraits<double> {
    static constexpr int inverse_sqrt_steps = 4;
    static double inverse_sqrt_seed(double a)
    {
        return std::bit_cast<double>(0x5fe6eb50c7b537a9u - (std::bit_cast<std::uint64_t>(a) >> 1));
    }
    static double choose(bool m, double a, double b) { return m ? a : b; }
    static bool is_finite(double a)
    {
        constexpr std::uint64_t exponent = 0x7ff0000000000000u;
        return (std::bit_cast<std::uint64_t>(a) & exponent) != exponent;
    }
    static bool both(bool a, bool b) { return a && b; }
    static bool any_lane(bool a) { return a; }
};

template <class T>
struct Laws {
#include "laws/laws_of_type.inl"
};

}  // namespace pliant
