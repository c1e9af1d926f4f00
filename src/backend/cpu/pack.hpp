// W floats that are computed at once: a thin layer over the compilers' vector extension, which becomes SSE,
// AVX, AVX-512 or NEON instructions by the flags of the including file. Without registers of W lanes the
// compiler uses several. Each file with its own flags has its own types of packs; otherwise shared templates
// would leak an instruction set into other files.
#pragma once

#include <cstdint>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "backend/host/inlining.hpp"
#include "backend/host/lanes.hpp"
#include "laws/laws.hpp"

/// The namespace of a file's packs, and thus of all functions that use them.
#if !defined(PLIANT_PACKS)
#define PLIANT_PACKS packs_of_baseline
#endif

/// 1 in files with fast arithmetic, whose results differ between machines (SimulationOptions::fast_math).
#if !defined(PLIANT_FAST_MATH)
#define PLIANT_FAST_MATH 0
#endif

namespace pliant {
inline namespace PLIANT_PACKS {

/// The compiler's vector types. Spelled out, since GCC applies vector_size too late if the size is a template
/// parameter.
template <int W>
struct LaneTypes;
#define PLIANT_LANE_TYPES(W)                                                           \
    template <>                                                                        \
    struct LaneTypes<W> {                                                              \
        typedef float Floats __attribute__((vector_size((W)*4)));                      \
        typedef float UnalignedFloats __attribute__((vector_size((W)*4), aligned(4))); \
        typedef std::int32_t Integers __attribute__((vector_size((W)*4)));             \
        typedef std::uint32_t Bits __attribute__((vector_size((W)*4)));                \
    };
PLIANT_LANE_TYPES(4)
PLIANT_LANE_TYPES(8)
PLIANT_LANE_TYPES(16)
#undef PLIANT_LANE_TYPES

template <int W>
struct PackMask {
    typename LaneTypes<W>::Integers lanes;  // 0 or -1
};

template <int W>
struct Pack {
    using Lanes = typename LaneTypes<W>::Floats;
    using UnalignedLanes = typename LaneTypes<W>::UnalignedFloats;
    using Mask = PackMask<W>;
    Lanes lanes;

    Pack() = default;
    PLIANT_SMALL Pack(Lanes a) : lanes(a) {}
    PLIANT_SMALL Pack(float a) : lanes(a - Lanes{}) {}
    Pack(double) = delete;  // a literal without f, or a narrowing, is an error in a law

    PLIANT_SMALL static Pack load(const float* p)
    {
        return Lanes(*reinterpret_cast<const UnalignedLanes*>(p));
    }
    PLIANT_SMALL void store(float* p) const { *reinterpret_cast<UnalignedLanes*>(p) = lanes; }

    PLIANT_SMALL friend Pack operator+(Pack a, Pack b) { return a.lanes + b.lanes; }
    PLIANT_SMALL friend Pack operator-(Pack a, Pack b) { return a.lanes - b.lanes; }
    PLIANT_SMALL friend Pack operator*(Pack a, Pack b) { return a.lanes * b.lanes; }
    PLIANT_SMALL friend Pack operator-(Pack a) { return -a.lanes; }
    PLIANT_SMALL friend Mask operator>(Pack a, Pack b) { return {a.lanes > b.lanes}; }
    PLIANT_SMALL friend Mask operator<(Pack a, Pack b) { return {a.lanes < b.lanes}; }
    PLIANT_SMALL friend Mask operator>=(Pack a, Pack b) { return {a.lanes >= b.lanes}; }
};

}  // namespace PLIANT_PACKS

template <int W>
struct NumberTraits<Pack<W>> {
    using Number = Pack<W>;
    using Mask = PackMask<W>;
    using Bits = typename LaneTypes<W>::Bits;
#if PLIANT_FAST_MATH
    /// The machine's estimate has 12 bits; one step then reaches rounding.
    static constexpr int inverse_sqrt_steps = 1;
#else
    static constexpr int inverse_sqrt_steps = NumberTraits<float>::inverse_sqrt_steps;
#endif

    PLIANT_SMALL static Number inverse_sqrt_seed(Number a)
    {
#if PLIANT_FAST_MATH
        // Also finite for 0: the value of the smallest normal number.
        const Number b = a.lanes > 0x1p-126f ? a.lanes : Number(0x1p-126f).lanes;
#if defined(__AVX512F__)
        if constexpr (W == 16)
            return (typename Number::Lanes)_mm512_maskz_rsqrt14_ps(0xffff, (__m512)b.lanes);
#endif
        if constexpr (W == 8) return (typename Number::Lanes)_mm256_rsqrt_ps((__m256)b.lanes);
#endif
        const Bits seed = 0x5f375a86u - (reinterpret_cast<Bits>(a.lanes) >> 1);
        return reinterpret_cast<typename Number::Lanes>(seed);
    }
    PLIANT_SMALL static Number choose(Mask m, Number a, Number b) { return m.lanes ? a.lanes : b.lanes; }
    PLIANT_SMALL static Mask is_finite(Number a)
    {
        const Bits exponent = reinterpret_cast<Bits>(a.lanes) & 0x7f800000u;
        return {exponent != 0x7f800000u};
    }
    PLIANT_SMALL static Mask both(Mask a, Mask b) { return {a.lanes & b.lanes}; }
    static bool any_lane(Mask m)
    {
#if defined(__AVX512F__)
        if constexpr (W == 16) return _mm512_test_epi32_mask((__m512i)m.lanes, (__m512i)m.lanes) != 0;
#endif
#if defined(__AVX__)
        if constexpr (W == 8) return _mm256_movemask_ps((__m256)m.lanes) != 0;
#endif
#if defined(__SSE2__)
        if constexpr (W == 4) return _mm_movemask_ps((__m128)m.lanes) != 0;
#endif
        for (int k = 0; k < W; ++k)
            if (m.lanes[k]) return true;
        return false;
    }
};

inline namespace PLIANT_PACKS {

/// N packs at once: interleaves N independent chains to hide latency. Members instead of an array, which GCC
/// would keep in memory.
template <class P, int N>
struct Group {
    using Rest = Group<P, N - 1>;
    struct Mask {
        typename P::Mask first;
        typename Rest::Mask rest;
    };
    P first;
    Rest rest;

    Group() = default;
    Group(P a, Rest others) : first(a), rest(others) {}
    Group(float a) : first(a), rest(a) {}
    Group(double) = delete;

    /// Calls f.template operator()<k>() for the members from k = begin on.
    template <int begin = 0, class Function>
    static PLIANT_INLINE Group of(const Function& f)
    {
        return {f.template operator()<begin>(), Rest::template of<begin + 1>(f)};
    }
    template <int k>
    PLIANT_INLINE P member() const
    {
        if constexpr (k == 0)
            return first;
        else
            return rest.template member<k - 1>();
    }
    friend PLIANT_INLINE Group operator+(const Group& a, const Group& b)
    {
        return {a.first + b.first, a.rest + b.rest};
    }
    friend PLIANT_INLINE Group operator-(const Group& a, const Group& b)
    {
        return {a.first - b.first, a.rest - b.rest};
    }
    friend PLIANT_INLINE Group operator*(const Group& a, const Group& b)
    {
        return {a.first * b.first, a.rest * b.rest};
    }
    friend PLIANT_INLINE Mask operator>(const Group& a, const Group& b)
    {
        return {a.first > b.first, a.rest > b.rest};
    }
};
template <class P>
struct Group<P, 1> {
    struct Mask {
        typename P::Mask first;
    };
    P first;

    Group() = default;
    Group(P a) : first(a) {}
    Group(float a) : first(a) {}

    template <int begin = 0, class Function>
    static PLIANT_INLINE Group of(const Function& f)
    {
        return {f.template operator()<begin>()};
    }
    template <int k>
    PLIANT_INLINE P member() const
    {
        return first;
    }
    friend PLIANT_INLINE Group operator+(const Group& a, const Group& b) { return {a.first + b.first}; }
    friend PLIANT_INLINE Group operator-(const Group& a, const Group& b) { return {a.first - b.first}; }
    friend PLIANT_INLINE Group operator*(const Group& a, const Group& b) { return {a.first * b.first}; }
    friend PLIANT_INLINE Mask operator>(const Group& a, const Group& b) { return {a.first > b.first}; }
};

}  // namespace PLIANT_PACKS

template <class P, int N>
struct NumberTraits<Group<P, N>> {
    static constexpr int inverse_sqrt_steps = NumberTraits<P>::inverse_sqrt_steps;

    static PLIANT_INLINE Group<P, N> inverse_sqrt_seed(const Group<P, N>& a)
    {
        if constexpr (N == 1)
            return {NumberTraits<P>::inverse_sqrt_seed(a.first)};
        else
            return {NumberTraits<P>::inverse_sqrt_seed(a.first),
                    NumberTraits<Group<P, N - 1>>::inverse_sqrt_seed(a.rest)};
    }
};

inline namespace PLIANT_PACKS {

/// Lane k of the result is lane Place::of(k) of a followed by b.
template <class Place, class Floats, int... k>
PLIANT_INLINE Floats shuffled(Floats a, Floats b, std::integer_sequence<int, k...>)
{
    return __builtin_shufflevector(a, b, Place::of(k)...);
}
template <int W, class Place, class Floats>
PLIANT_INLINE Floats shuffled(Floats a, Floats b)
{
    return shuffled<Place>(a, b, std::make_integer_sequence<int, W>());
}

/// Every second lane of a, then of b, from `first`, 0 or 1, on. For 8 lanes in two steps, since no single
/// instruction crosses halves and also moves lanes of both inputs.
template <int first>
struct SecondLane {
    static consteval int of(int k) { return first + 2 * k; }
};
template <int first>
struct SecondLaneByHalves {
    static consteval int of(int k) { return first + k / 4 * 4 + (k % 4 < 2 ? 2 * k % 4 : 8 + 2 * k % 4); }
};
struct MiddlePairsSwapped {
    static consteval int of(int k) { return k / 2 % 3 == 0 ? k : k < 4 ? k + 2 : k - 2; }
};
template <int W, int first, class Floats>
PLIANT_INLINE Floats second_lanes(Floats a, Floats b)
{
    if constexpr (W == 8) {
        const Floats pairs = shuffled<W, SecondLaneByHalves<first>>(a, b);
        return shuffled<W, MiddlePairsSwapped>(pairs, pairs);
    } else {
        return shuffled<W, SecondLane<first>>(a, b);
    }
}

/// Interleaves the lanes of a and b, from lane `first` on.
template <int W, int first>
struct LaneByTurns {
    static consteval int of(int k) { return first + k / 2 + k % 2 * W; }
};
template <int W, int first, class Floats>
PLIANT_INLINE Floats lanes_by_turns(Floats a, Floats b)
{
    return shuffled<W, LaneByTurns<W, first>>(a, b);
}

}  // namespace PLIANT_PACKS

template <int W>
struct Lanes<Pack<W>> {
    using Number = float;
    using T = Pack<W>;
    static constexpr int count = W;
    static T load(const float* p) { return T::load(p); }
    static T load_even(const float* p) { return second_lanes<W, 0>(T::load(p).lanes, T::load(p + W).lanes); }
    static void store(float* p, T a) { a.store(p); }
    static T even_of(T a, T b) { return second_lanes<W, 0>(a.lanes, b.lanes); }
    static T odd_of(T a, T b) { return second_lanes<W, 1>(a.lanes, b.lanes); }
    static void add_by_turns(float* p, T even, T odd, const float* where_low, const float* where_high)
    {
        const T zero(0.0f);
        const T low = lanes_by_turns<W, 0>(even.lanes, odd.lanes);
        const T high = lanes_by_turns<W, W / 2>(even.lanes, odd.lanes);
        (T::load(p) + NumberTraits<T>::choose(T::load(where_low) > zero, low, zero)).store(p);
        (T::load(p + W) + NumberTraits<T>::choose(T::load(where_high) > zero, high, zero)).store(p + W);
    }
    static T spread(float a) { return T(a); }
    static float first(T a) { return a.lanes[0]; }
    static PackMask<W> first_lanes(int number)
    {
        typename LaneTypes<W>::Integers lane;
        for (int k = 0; k < W; ++k) lane[k] = k;
        return {lane < number};
    }
    static float sum(T a)
    {
        float lanes[W];
        a.store(lanes);
        for (int half = W / 2; half > 0; half /= 2)
            for (int k = 0; k < half; ++k) lanes[k] += lanes[k + half];
        return lanes[0];
    }
};

}  // namespace pliant
