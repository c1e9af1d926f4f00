// Packs of vectors that lie node by node: four floats each, the last of them padding. A gather then takes one
// load for a vector, where planes take one for each of its numbers, and touches one cache line for a node.
#pragma once

#include "backend/cpu/pack.hpp"

namespace pliant {
inline namespace PLIANT_PACKS {

typedef float Quad __attribute__((vector_size(16)));

/// Lanes i0 ... i3 of each quad of a (0 to 3) and of b (4 to 7), quad by quad.
template <int W, int i0, int i1, int i2, int i3>
struct LaneOfQuads {
    static consteval int of(int k)
    {
        const int from = k % 4 == 0 ? i0 : k % 4 == 1 ? i1 : k % 4 == 2 ? i2 : i3, quad = k / 4 * 4;
        return from < 4 ? quad + from : W + quad + from - 4;
    }
};
template <int W, int i0, int i1, int i2, int i3, class Floats>
PLIANT_INLINE Floats quads_of(Floats a, Floats b)
{
    return shuffled<W, LaneOfQuads<W, i0, i1, i2, i3>>(a, b);
}

/// a, and behind it b.
PLIANT_INLINE auto two_quads(const Quad& a, const Quad& b)
{
#if defined(__AVX__)
    // GCC 12 does not load into the upper half by itself.
    return LaneTypes<8>::Floats(_mm256_insertf128_ps(_mm256_castps128_ps256(a), b, 1));
#else
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
#endif
}

/// The quads of lanes `first`, first + 4, ..., one behind the other: f(lane) is a quad.
template <int W, int first, class Function>
PLIANT_INLINE typename LaneTypes<W>::Floats every_fourth_quad(const Function& f)
{
    if constexpr (W == 4) {
        return f(first);
    } else if constexpr (W == 8) {
        return two_quads(f(first), f(first + 4));
    } else {
        const auto low = two_quads(f(first), f(first + 4)), high = two_quads(f(first + 8), f(first + 12));
        return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    }
}

/// Four packs, or the four numbers of each lane's quad.
template <int W>
struct QuadPacks {
    Pack<W> x, y, z, w;
};
/// f(lane) is the quad of a lane.
template <int W, class Function>
PLIANT_INLINE QuadPacks<W> packs_from_quads(const Function& f)
{
    const auto r0 = every_fourth_quad<W, 0>(f), r1 = every_fourth_quad<W, 1>(f),
               r2 = every_fourth_quad<W, 2>(f), r3 = every_fourth_quad<W, 3>(f);
    const auto xy01 = quads_of<W, 0, 4, 1, 5>(r0, r1), zw01 = quads_of<W, 2, 6, 3, 7>(r0, r1);
    const auto xy23 = quads_of<W, 0, 4, 1, 5>(r2, r3), zw23 = quads_of<W, 2, 6, 3, 7>(r2, r3);
    return {quads_of<W, 0, 1, 4, 5>(xy01, xy23), quads_of<W, 2, 3, 6, 7>(xy01, xy23),
            quads_of<W, 0, 1, 4, 5>(zw01, zw23), quads_of<W, 2, 3, 6, 7>(zw01, zw23)};
}
/// f(lane) is the vector of a lane, as a quad.
template <int W, class Function>
PLIANT_INLINE Vector3<Pack<W>> vectors_from_quads(const Function& f)
{
    const QuadPacks<W> packs = packs_from_quads<W>(f);
    return {packs.x, packs.y, packs.z};
}

/// Leaves a lane's quad with f(lane, quad).
template <int W, class Function>
PLIANT_INLINE void quads_from_packs(const QuadPacks<W>& a, const Function& f)
{
    const auto xy01 = quads_of<W, 0, 4, 1, 5>(a.x.lanes, a.y.lanes),
               xy23 = quads_of<W, 2, 6, 3, 7>(a.x.lanes, a.y.lanes),
               zw01 = quads_of<W, 0, 4, 1, 5>(a.z.lanes, a.w.lanes),
               zw23 = quads_of<W, 2, 6, 3, 7>(a.z.lanes, a.w.lanes);
    const typename LaneTypes<W>::Floats rows[4] = {
        quads_of<W, 0, 1, 4, 5>(xy01, zw01), quads_of<W, 2, 3, 6, 7>(xy01, zw01),
        quads_of<W, 0, 1, 4, 5>(xy23, zw23), quads_of<W, 2, 3, 6, 7>(xy23, zw23)};
    for (int k = 0; k < 4; ++k) {
        if constexpr (W == 4) f(k, rows[k]);
        if constexpr (W >= 8) {
            f(k, __builtin_shufflevector(rows[k], rows[k], 0, 1, 2, 3));
            f(k + 4, __builtin_shufflevector(rows[k], rows[k], 4, 5, 6, 7));
        }
        if constexpr (W == 16) {
            f(k + 8, __builtin_shufflevector(rows[k], rows[k], 8, 9, 10, 11));
            f(k + 12, __builtin_shufflevector(rows[k], rows[k], 12, 13, 14, 15));
        }
    }
}
template <int W, class Function>
PLIANT_INLINE void quads_from_vectors(const Vector3<Pack<W>>& a, const Function& f)
{
    quads_from_packs<W>({a.x, a.y, a.z, Pack<W>(0.0f)}, f);
}

}  // namespace PLIANT_PACKS

template <int W>
struct Records<Pack<W>> {
    using T = Pack<W>;
    using Vector = Vector3<T>;
    static PLIANT_SMALL Quad quad(const float* p)
    {
        Quad a;
        __builtin_memcpy(&a, p, sizeof a);
        return a;
    }
    static PLIANT_SMALL void put(float* p, const Quad& a) { __builtin_memcpy(p, &a, sizeof a); }

    template <int stride>
    static PLIANT_INLINE Vector vectors(const float* records, const std::int32_t* place)
    {
        return vectors_from_quads<W>([&](int lane) { return quad(records + stride * place[lane]); });
    }
    static PLIANT_INLINE Vector differences(const float* records, const std::int32_t* from,
                                            const std::int32_t* to)
    {
        return vectors_from_quads<W>(
            [&](int lane) { return quad(records + to[lane]) - quad(records + from[lane]); });
    }
    template <int stride>
    static PLIANT_INLINE void store(float* records, const Vector& a)
    {
        quads_from_vectors<W>(a, [&](int lane, const Quad& values) { put(records + stride * lane, values); });
    }
    static PLIANT_INLINE FourNumbers<T> fours(const float* records, const std::int32_t* twice)
    {
        const QuadPacks<W> packs =
            packs_from_quads<W>([&](int lane) { return quad(records + 4 * (twice[lane] >> 1)); });
        return {packs.x, packs.y, packs.z, packs.w};
    }
    /// Calls put_lane(lane, quad) for the first `count` lanes.
    template <class Put>
    static PLIANT_INLINE void store_some(const QuadPacks<W>& a, int count, const Put& put_lane)
    {
        if (count >= W) return quads_from_packs<W>(a, put_lane);
        quads_from_packs<W>(a, [&](int lane, const Quad& values) {
            if (lane < count) put_lane(lane, values);
        });
    }
    static PLIANT_INLINE void store_fours(float* records, const FourNumbers<T>& a, int count)
    {
        store_some({a.x, a.y, a.z, a.w}, count,
                   [&](int lane, const Quad& values) { put(records + 4 * lane, values); });
    }
    template <int shift>
    static PLIANT_INLINE SixNumbers<T> sixes(const float* records, const std::int32_t* place)
    {
        const auto first = [&](int lane) { return records + 6 * (place[lane] >> shift); };
        const QuadPacks<W> low = packs_from_quads<W>([&](int lane) { return quad(first(lane)); });
        const QuadPacks<W> high = packs_from_quads<W>([&](int lane) { return quad(first(lane) + 2); });
        return {{low.x, low.y, low.z, low.w, high.z, high.w}};
    }
    template <class Place>
    static PLIANT_INLINE void store_sixes(float* records, const SixNumbers<T>& a, int count,
                                          const Place& place)
    {
        const T* n = a.numbers;
        store_some({n[0], n[1], n[2], n[3]}, count,
                   [&](int lane, const Quad& values) { put(records + 6 * place(lane), values); });
        store_some({n[2], n[3], n[4], n[5]}, count,
                   [&](int lane, const Quad& values) { put(records + 6 * place(lane) + 2, values); });
    }
    /// 1 where an integer is even, and -1 where it is odd.
    static PLIANT_INLINE T signs(const std::int32_t* integers)
    {
        typename LaneTypes<W>::Bits bits;
        __builtin_memcpy(&bits, integers, sizeof bits);
        return reinterpret_cast<typename T::Lanes>(bits << 31 | 0x3f800000u);
    }
};

}  // namespace pliant
