// Edges and components of a triangle mesh, for inspection and repair.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "pliant/api.hpp"
#include "pliant/mesh.hpp"

namespace pliant {

/// Throws Error(bad_input) unless every index has its vertex and every coordinate is finite.
PLIANT_INSIDE void require_valid(const SurfaceMesh& mesh);

/// Disjoint sets of 0 .. n-1, with path halving. The root of a set is its smallest member.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t n)
    {
        parents_.reserve(n);
        for (std::size_t i = 0; i < n; ++i) parents_.push_back(i);
    }

    std::size_t root(std::size_t i)
    {
        while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
        return i;
    }
    bool is_root(std::size_t i) const { return parents_[i] == i; }
    void join(std::size_t a, std::size_t b)
    {
        const auto [low, high] = std::minmax({root(a), root(b)});
        parents_[high] = low;
    }

private:
    std::vector<std::size_t> parents_;
};

/// One side of a triangle, from corner `side` of the triangle to the next one.
struct EdgeUse {
    std::uint32_t low, high;  // the two vertices
    std::size_t corner;       // 3 * triangle + side

    bool same_edge(const EdgeUse& other) const { return low == other.low && high == other.high; }
    std::size_t triangle() const { return corner / 3; }
    /// Whether its triangle traverses it from low to high.
    bool goes_up(const SurfaceMesh& mesh) const { return mesh.triangles[corner / 3][corner % 3] == low; }
};

inline bool has_repeated_vertex(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// All sides, grouped by edge. A triangle (a, a, b) uses the edge a-b once.
std::vector<EdgeUse> edge_uses(const SurfaceMesh& mesh);

/// Calls `visit` with the uses of each edge.
template <class Visit>
void for_each_edge(std::span<const EdgeUse> uses, Visit visit)
{
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
        while (end < uses.size() && uses[end].same_edge(uses[begin])) ++end;
        visit(uses.subspan(begin, end - begin));
    }
}

double edge_length(const SurfaceMesh& mesh, const EdgeUse& edge);  ///< m

/// Chains of boundary edges, ordered by their first vertex.
std::vector<BoundaryLoop> boundary_loops(const SurfaceMesh& mesh, std::span<const EdgeUse> uses);

/// The component of each triangle, numbered in the order of their first triangles. Triangles that share a
/// vertex are in one component.
struct Components {
    std::vector<std::uint32_t> of_triangle;
    std::size_t count = 0;
};
Components components_of(const SurfaceMesh& mesh);

/// Whether the triangle's height is within the rounding of its float coordinates.
bool is_flat(const SurfaceMesh& mesh, const Triangle& triangle);

/// Six times the signed volume between the triangle and the origin, m^3.
inline double volume6(const SurfaceMesh& mesh, const Triangle& t, Vec3d origin)
{
    return dot(to_double(mesh.vertices[t[0]]) - origin,
               cross(to_double(mesh.vertices[t[1]]) - origin, to_double(mesh.vertices[t[2]]) - origin));
}

/// m^3; a closed surface of this area (m^2) with less volume counts as flat. A ball has 0.09 area^1.5; a
/// square plate has this volume if its thickness is 3e-6 of its width.
inline double flat_volume(double area) { return 1e-6 * area * std::sqrt(area); }

}  // namespace pliant
