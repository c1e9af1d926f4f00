// Polygons of a file, and their triangulation.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pliant/mesh.hpp"

namespace pliant {

/// The faces of a file before triangulation, concatenated.
struct Polygons {
    std::vector<std::uint32_t> corners;
    std::vector<std::size_t> ends;  ///< the end of each polygon in `corners`

    std::size_t count() const { return ends.size(); }
    std::span<const std::uint32_t> polygon(std::size_t i) const
    {
        const std::size_t begin = i == 0 ? 0 : ends[i - 1];
        return std::span(corners).subspan(begin, ends[i] - begin);
    }
};

/// The maximum number of corners of a polygon that is not strictly convex: ear clipping takes quadratic time.
inline constexpr std::size_t concave_corner_limit = 1000;

/// Appends the n - 2 triangles of a polygon of n >= 3 corners: a fan if it is strictly convex, else by ear
/// clipping, which is correct for every simple polygon that is nearly planar. A remainder without ears (the
/// polygon intersects itself, or has no area) becomes a fan. Every index must be in range. Returns false, and
/// appends nothing, if the polygon is not strictly convex and exceeds the limit.
[[nodiscard]] bool append_triangles(std::span<const std::uint32_t> polygon, const std::vector<Vec3>& vertices,
                                    std::vector<Triangle>& triangles);

}  // namespace pliant
