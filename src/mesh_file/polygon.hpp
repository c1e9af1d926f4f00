// Polygons as the files give them, cut into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pliant/mesh.hpp"

namespace pliant {

/// The faces of a file before they are triangulated, one after the other.
struct Polygons {
    std::vector<std::uint32_t> corners;
    std::vector<std::size_t> ends;  ///< where in `corners` each polygon ends

    std::size_t count() const { return ends.size(); }
    std::span<const std::uint32_t> polygon(std::size_t i) const
    {
        const std::size_t begin = i == 0 ? 0 : ends[i - 1];
        return std::span(corners).subspan(begin, ends[i] - begin);
    }
};

/// Polygons that are not strictly convex may have this many corners: cutting them takes time quadratic in it.
inline constexpr std::size_t concave_corner_limit = 1000;

/// Appends the n - 2 triangles of a polygon of n >= 3 corners: a fan when it is strictly convex, else cut by
/// ears, which is right for every simple polygon that is about planar. The rest of a polygon without ears (it
/// crosses itself, or has no area) becomes a fan. Every index must have its vertex. False, and nothing
/// appended, when the polygon is not strictly convex and above the limit.
[[nodiscard]] bool append_triangles(std::span<const std::uint32_t> polygon, const std::vector<Vec3>& vertices,
                                    std::vector<Triangle>& triangles);

}  // namespace pliant
