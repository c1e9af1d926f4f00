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

/// f(lane) is the vector of a lane, as a quad.
template <int W, class Function>
PLIANT_INLINE Vector3<Pack<W>> vectors_from_quads(const Function& f)
{
    const auto r0 = every_fourth_quad<W, 0>(f), r1 = every_fourth_quad<W, 1>(f),
               r2 = every_fourth_quad<W, 2>(f), r3 = every_fourth_quad<W, 3>(f);
    const auto xy01 = quads_of<W, 0, 4, 1, 5>(r0, r1), z01 = quads_of<W, 2, 6, 3, 7>(r0, r1);
    const auto xy23 = quads_of<W, 0, 4, 1, 5>(r2, r3), z23 = quads_of<W, 2, 6, 3, 7>(r2, r3);
    return {quads_of<W, 0, 1, 4, 5>(xy01, xy23), quads_of<W, 2, 3, 6, 7>(xy01, xy23),
            quads_of<W, 0, 1, 4, 5>(z01, z23)};
}

/// Leaves a lane's vector with f(lane, quad).
template <int W, class Function>
PLIANT_INLINE void quads_from_vectors(const Vector3<Pack<W>>& a, const Function& f)
{
    const typename LaneTypes<W>::Floats none{};
    const auto xy01 = quads_of<W, 0, 4, 1, 5>(a.x.lanes, a.y.lanes),
               xy23 = quads_of<W, 2, 6, 3, 7>(a.x.lanes, a.y.lanes),
               z01 = quads_of<W, 0, 4, 1, 5>(a.z.lanes, none), z23 = quads_of<W, 2, 6, 3, 7>(a.z.lanes, none);
    const typename LaneTypes<W>::Floats rows[4] = {
        quads_of<W, 0, 1, 4, 5>(xy01, z01), quads_of<W, 2, 3, 6, 7>(xy01, z01),
        quads_of<W, 0, 1, 4, 5>(xy23, z23), quads_of<W, 2, 3, 6, 7>(xy23, z23)};
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

}  // namespace PLIANT_PACKS
}  // namespace pliant
