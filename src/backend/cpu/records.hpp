// Packs of vectors stored node by node: four floats each, the last of them padding. A gather then needs one
// load and one cache line per vector; planes need one of each per coordinate.
#pragma once

#include "backend/cpu/pack.hpp"

namespace pliant {
inline namespace PLIANT_PACKS {

typedef float Quad __attribute__((vector_size(16)));

/// Lanes i0 ... i3 of each quad of a (0 to 3) and b (4 to 7), quad by quad.
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

/// a followed by b.
PLIANT_INLINE auto two_quads(const Quad& a, const Quad& b)
{
#if defined(__AVX__)
    // GCC 12 does not combine the load with the insertion.
    return LaneTypes<8>::Floats(_mm256_insertf128_ps(_mm256_castps128_ps256(a), b, 1));
#else
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
#endif
}

/// The quads of lanes `first`, first + 4, ..., concatenated; f(lane) is a quad.
template <int W, int first, class Function>
PLIANT_INLINE typename LaneTypes<W>::Floats every_fourth_quad(const Function& f)
{
    if constexpr (W == 4) {
        return f(first);
    } else if constexpr (W == 8) {
        return two_quads(f(first), f(first + 4));
    } else {
#if defined(__AVX512F__)
        // Loads from memory use any port; combining halves would make GCC emit shuffles.
        __m512 quads = _mm512_castps128_ps512((__m128)f(first));
        quads = _mm512_insertf32x4(quads, (__m128)f(first + 4), 1);
        quads = _mm512_insertf32x4(quads, (__m128)f(first + 8), 2);
        return (typename LaneTypes<W>::Floats)_mm512_insertf32x4(quads, (__m128)f(first + 12), 3);
#else
        const auto low = two_quads(f(first), f(first + 4)), high = two_quads(f(first + 8), f(first + 12));
        return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
#endif
    }
}

/// Four packs: the four numbers of each lane's quad.
template <int W>
struct QuadPacks {
    Pack<W> x, y, z, w;
};
/// Transposes quads of lanes; r0 has those of every fourth lane from 0 on, r1 from 1 on, ...
template <int W, class Floats>
PLIANT_INLINE QuadPacks<W> packs_of_rows(Floats r0, Floats r1, Floats r2, Floats r3)
{
    const auto xy01 = quads_of<W, 0, 4, 1, 5>(r0, r1), zw01 = quads_of<W, 2, 6, 3, 7>(r0, r1);
    const auto xy23 = quads_of<W, 0, 4, 1, 5>(r2, r3), zw23 = quads_of<W, 2, 6, 3, 7>(r2, r3);
    return {quads_of<W, 0, 1, 4, 5>(xy01, xy23), quads_of<W, 2, 3, 6, 7>(xy01, xy23),
            quads_of<W, 0, 1, 4, 5>(zw01, zw23), quads_of<W, 2, 3, 6, 7>(zw01, zw23)};
}
/// f(lane) is the quad of a lane.
template <int W, class Function>
PLIANT_INLINE QuadPacks<W> packs_from_quads(const Function& f)
{
    const auto r0 = every_fourth_quad<W, 0>(f), r1 = every_fourth_quad<W, 1>(f),
               r2 = every_fourth_quad<W, 2>(f), r3 = every_fourth_quad<W, 3>(f);
    return packs_of_rows<W>(r0, r1, r2, r3);
}

/// Two quads per lane.
template <int W>
struct TwoQuadPacks {
    QuadPacks<W> first, second;
};
/// f(lane) and g(lane) are quads of a lane, called alternately so that addresses of a lane need few
/// registers.
template <int W, class First, class Second>
PLIANT_INLINE TwoQuadPacks<W> packs_from_two_quads(const First& f, const Second& g)
{
    const auto r0 = every_fourth_quad<W, 0>(f), s0 = every_fourth_quad<W, 0>(g);
    const auto r1 = every_fourth_quad<W, 1>(f), s1 = every_fourth_quad<W, 1>(g);
    const auto r2 = every_fourth_quad<W, 2>(f), s2 = every_fourth_quad<W, 2>(g);
    const auto r3 = every_fourth_quad<W, 3>(f), s3 = every_fourth_quad<W, 3>(g);
    return {packs_of_rows<W>(r0, r1, r2, r3), packs_of_rows<W>(s0, s1, s2, s3)};
}

/// Eight consecutive floats of each lane: f(lane) is the first four, followed by the others.
template <int W, int first>
struct QuadsOfOctets {
    static consteval int of(int k) { return (k / 4 % 2 * 8) + (k / 8 * W) + 4 * first + k % 4; }
};
template <int W>
struct OctetRows {
    typename LaneTypes<W>::Floats quads, others;
};
template <int W, int first, class Function>
PLIANT_INLINE OctetRows<W> every_fourth_octet(const Function& f)
{
    using Floats = typename LaneTypes<W>::Floats;
    OctetRows<W> rows;
    if constexpr (W == 8) {
        const Floats a = f(first), b = f(first + 4);
        rows.quads = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
        rows.others = __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
    } else {
        const auto both = [](auto a, auto b) {
            return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
        };
        const Floats low = both(f(first), f(first + 4)), high = both(f(first + 8), f(first + 12));
        rows.quads = shuffled<W, QuadsOfOctets<W, 0>>(low, high);
        rows.others = shuffled<W, QuadsOfOctets<W, 1>>(low, high);
    }
    return rows;
}
template <int W, class Function>
PLIANT_INLINE TwoQuadPacks<W> packs_from_octets(const Function& f)
{
    const OctetRows<W> r0 = every_fourth_octet<W, 0>(f), r1 = every_fourth_octet<W, 1>(f),
                       r2 = every_fourth_octet<W, 2>(f), r3 = every_fourth_octet<W, 3>(f);
    return {packs_of_rows<W>(r0.quads, r1.quads, r2.quads, r3.quads),
            packs_of_rows<W>(r0.others, r1.others, r2.others, r3.others)};
}
/// f(lane) is the vector of a lane, as a quad.
template <int W, class Function>
PLIANT_INLINE Vector3<Pack<W>> vectors_from_quads(const Function& f)
{
    const QuadPacks<W> packs = packs_from_quads<W>(f);
    return {packs.x, packs.y, packs.z};
}

/// The quads of lanes, in the order of packs_of_rows.
template <int W>
struct QuadRows {
    typename LaneTypes<W>::Floats rows[4];
};
template <int W>
PLIANT_INLINE QuadRows<W> rows_of_packs(const QuadPacks<W>& a)
{
    const auto xy01 = quads_of<W, 0, 4, 1, 5>(a.x.lanes, a.y.lanes),
               xy23 = quads_of<W, 2, 6, 3, 7>(a.x.lanes, a.y.lanes),
               zw01 = quads_of<W, 0, 4, 1, 5>(a.z.lanes, a.w.lanes),
               zw23 = quads_of<W, 2, 6, 3, 7>(a.z.lanes, a.w.lanes);
    return {{quads_of<W, 0, 1, 4, 5>(xy01, zw01), quads_of<W, 2, 3, 6, 7>(xy01, zw01),
             quads_of<W, 0, 1, 4, 5>(xy23, zw23), quads_of<W, 2, 3, 6, 7>(xy23, zw23)}};
}
/// Calls f(lane, quad) with each lane's quad.
template <int W, class Function>
PLIANT_INLINE void quads_from_packs(const QuadPacks<W>& a, const Function& f)
{
    const auto [rows] = rows_of_packs<W>(a);
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
/// Calls f(k, floats) with the quads of lanes in order: the k-th W floats.
template <int W>
struct LowQuadsByTurns {
    static consteval int of(int k) { return k / 4 % 2 * W + k / 8 * 4 + k % 4; }
};
template <int W>
struct HighQuadsByTurns {
    static consteval int of(int k) { return LowQuadsByTurns<W>::of(k) + W / 2; }
};
template <int W>
struct LowHalves {
    static consteval int of(int k) { return k < W / 2 ? k : k + W / 2; }
};
template <int W>
struct HighHalves {
    static consteval int of(int k) { return LowHalves<W>::of(k) + W / 2; }
};
template <int W, class Function>
PLIANT_INLINE void quads_in_a_row(const QuadPacks<W>& a, const Function& f)
{
    const auto [rows] = rows_of_packs<W>(a);
    if constexpr (W == 4) {
        for (int k = 0; k < 4; ++k) f(k, rows[k]);
    } else if constexpr (W == 8) {
        for (int k = 0; k < 4; k += 2) {
            f(k / 2, __builtin_shufflevector(rows[k], rows[k + 1], 0, 1, 2, 3, 8, 9, 10, 11));
            f(2 + k / 2, __builtin_shufflevector(rows[k], rows[k + 1], 4, 5, 6, 7, 12, 13, 14, 15));
        }
    } else {
        // Pairs of every fourth lane, then pairs of these.
        const auto low01 = shuffled<W, LowQuadsByTurns<W>>(rows[0], rows[1]),
                   low23 = shuffled<W, LowQuadsByTurns<W>>(rows[2], rows[3]),
                   high01 = shuffled<W, HighQuadsByTurns<W>>(rows[0], rows[1]),
                   high23 = shuffled<W, HighQuadsByTurns<W>>(rows[2], rows[3]);
        f(0, shuffled<W, LowHalves<W>>(low01, low23));
        f(1, shuffled<W, HighHalves<W>>(low01, low23));
        f(2, shuffled<W, LowHalves<W>>(high01, high23));
        f(3, shuffled<W, HighHalves<W>>(high01, high23));
    }
}

template <int W, class Function>
PLIANT_INLINE void quads_from_vectors(const Vector3<Pack<W>>& a, const Function& f)
{
    quads_from_packs<W>({a.x, a.y, a.z, Pack<W>(0.0f)}, f);
}

/// For 16 lanes, pairs of numbers a, b and c of 8 lanes, lane after lane: the k-th 16 floats, first without
/// c.
template <int part>
struct PairsInARow {
    static consteval int of(int k)
    {
        const int pair = 8 * part + k / 2, from = pair % 3, place = 2 * (pair / 3) + k % 2;
        return from == 0 ? place : from == 1 ? 16 + place : 0;
    }
};
template <int part>
struct ThirdPairsInARow {
    static consteval int of(int k)
    {
        const int pair = 8 * part + k / 2;
        return pair % 3 == 2 ? 16 + 2 * (pair / 3) + k % 2 : k;
    }
};
template <int part, class Floats>
PLIANT_INLINE Floats pairs_in_a_row(Floats a, Floats b, Floats c)
{
    return shuffled<16, ThirdPairsInARow<part>>(shuffled<16, PairsInARow<part>>(a, b), c);
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
    static PLIANT_SMALL auto octet(const float* p)
    {
        typename LaneTypes<8>::Floats a;
        __builtin_memcpy(&a, p, sizeof a);
        return a;
    }
    using Distance = std::ptrdiff_t;

    template <int stride>
    static PLIANT_INLINE Vector vectors(const float* records, const std::int32_t* place)
    {
        return vectors_from_quads<W>([&](int lane) { return quad(records + stride * place[lane]); });
    }
    /// Of two records of eight floats: the difference of the first vectors, and the second vectors.
    struct TwoVectors {
        Vector first, second;
    };
    static PLIANT_INLINE TwoVectors differences(const float* records, const std::int32_t* from,
                                                const std::int32_t* to)
    {
        TwoQuadPacks<W> packs;
        if constexpr (W == 4) {
            packs = packs_from_two_quads<W>(
                [&](int lane) { return quad(records + to[lane]) - quad(records + from[lane]); },
                [&](int lane) { return quad(records + to[lane] + 4) - quad(records + from[lane] + 4); });
        } else {
            packs = packs_from_octets<W>(
                [&](int lane) { return octet(records + to[lane]) - octet(records + from[lane]); });
        }
        const QuadPacks<W>&a = packs.first, &b = packs.second;
        return {{a.x, a.y, a.z}, {b.x, b.y, b.z}};
    }
    template <int stride>
    static PLIANT_INLINE void store(float* records, const Vector& a)
    {
        if constexpr (stride == 4)
            return quads_in_a_row<W>({a.x, a.y, a.z, T(0.0f)},
                                     [&](int k, const T& floats) { floats.store(records + W * k); });
        quads_from_vectors<W>(a, [&](int lane, const Quad& values) { put(records + stride * lane, values); });
    }
    /// `stride`: floats from one place to the next.
    template <int stride>
    static PLIANT_INLINE FourNumbers<T> fours(const float* records, const std::int32_t* place)
    {
        const QuadPacks<W> packs =
            packs_from_quads<W>([&](int lane) { return quad(records + Distance{place[lane]} * stride); });
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
        if (count >= W)
            return quads_in_a_row<W>({a.x, a.y, a.z, a.w},
                                     [&](int k, const T& floats) { floats.store(records + W * k); });
        store_some({a.x, a.y, a.z, a.w}, count,
                   [&](int lane, const Quad& values) { put(records + 4 * lane, values); });
    }
    template <int stride>
    static PLIANT_INLINE SixNumbers<T> sixes(const float* records, const std::int32_t* place)
    {
        const auto first = [&](int lane) { return records + Distance{place[lane]} * stride; };
        const auto [low, high] = packs_from_two_quads<W>([&](int lane) { return quad(first(lane)); },
                                                         [&](int lane) { return quad(first(lane) + 2); });
        return {{low.x, low.y, low.z, low.w, high.z, high.w}};
    }
    /// The same for neighbouring lanes, consecutively.
    static PLIANT_INLINE void store_sixes_in_a_row(float* records, const SixNumbers<T>& a, int count)
    {
        if constexpr (W == 16)
            if (count >= W) {
                const T* n = a.numbers;
                store_eight_sixes<0>(records, n);
                return store_eight_sixes<W / 2>(records + 3 * W, n);
            }
        store_sixes(records, a, count, [](int lane) { return lane; });
    }
    template <int first>
    static PLIANT_INLINE void store_eight_sixes(float* records, const T* n)
    {
        const auto a = lanes_by_turns<W, first>(n[0].lanes, n[1].lanes),
                   b = lanes_by_turns<W, first>(n[2].lanes, n[3].lanes),
                   c = lanes_by_turns<W, first>(n[4].lanes, n[5].lanes);
        T(pairs_in_a_row<0>(a, b, c)).store(records);
        T(pairs_in_a_row<1>(a, b, c)).store(records + W);
        T(pairs_in_a_row<2>(a, b, c)).store(records + 2 * W);
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
};

}  // namespace pliant
