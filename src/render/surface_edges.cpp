#include "render/surface_edges.hpp"

#include <algorithm>
#include <tuple>

namespace pliant {

std::vector<SurfaceEdge> edges_of(std::span<const Triangle> triangles)
{
    struct Side {
        std::uint32_t low, high, triangle;
        SurfaceEdge edge;
    };
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3],
                                c = triangles[t][(k + 2) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), t, {a, b, c, no_corner}});
        }
    std::ranges::sort(sides, [](const Side& x, const Side& y) {
        return std::tie(x.low, x.high, x.triangle) < std::tie(y.low, y.high, y.triangle);
    });
    std::vector<SurfaceEdge> edges;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        edges.push_back(sides[i].edge);
        if (i + 1 == sides.size() || sides[i + 1].low != sides[i].low || sides[i + 1].high != sides[i].high)
            continue;
        edges.back()[3] = sides[++i].edge[2];
    }
    return edges;
}

}  // namespace pliant
