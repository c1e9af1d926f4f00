#include "mesh/mesh_topology.hpp"

#include <cmath>
#include <limits>
#include <tuple>

#include "files/formatted.hpp"
#include "pliant/error.hpp"

namespace pliant {

std::vector<EdgeUse> edge_uses(const SurfaceMesh& mesh)
{
    std::vector<EdgeUse> uses;
    uses.reserve(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& triangle = mesh.triangles[t];
        const std::size_t sides_before = uses.size();
        for (std::size_t side = 0; side < 3; ++side) {
            const auto [low, high] = std::minmax({triangle[side], triangle[(side + 1) % 3]});
            const EdgeUse use{low, high, 3 * t + side};
            const bool again =
                std::any_of(uses.begin() + static_cast<std::ptrdiff_t>(sides_before), uses.end(),
                            [&](const EdgeUse& earlier) { return use.same_edge(earlier); });
            if (low != high && !again) uses.push_back(use);
        }
    }
    std::ranges::sort(uses, {}, [](const EdgeUse& use) { return std::tuple(use.low, use.high, use.corner); });
    return uses;
}

double edge_length(const SurfaceMesh& mesh, const EdgeUse& edge)
{
    const Vec3d along = to_double(mesh.vertices[edge.high]) - to_double(mesh.vertices[edge.low]);
    return std::sqrt(dot(along, along));
}

std::vector<BoundaryLoop> boundary_loops(const SurfaceMesh& mesh, std::span<const EdgeUse> uses)
{
    DisjointSets chains(mesh.vertices.size());
    std::vector<EdgeUse> boundary;
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
        if (edge.size() != 1) return;
        chains.join(edge[0].low, edge[0].high);
        boundary.push_back(edge[0]);
    });
    std::vector<BoundaryLoop> loops;
    // Edges are sorted by their lower vertex, and a chain's root is its lowest.
    for (const EdgeUse& edge : boundary) {
        const auto first = static_cast<std::uint32_t>(chains.root(edge.low));
        if (edge.low == first && (loops.empty() || loops.back().vertex != first))
            loops.push_back({first, to_double(mesh.vertices[first]), 0, 0});
        const auto loop = std::ranges::lower_bound(loops, first, {}, &BoundaryLoop::vertex);
        ++loop->edges;
        loop->length += edge_length(mesh, edge);
    }
    return loops;
}

Components components_of(const SurfaceMesh& mesh)
{
    DisjointSets parts(mesh.vertices.size());
    for (const Triangle& triangle : mesh.triangles) {
        parts.join(triangle[0], triangle[1]);
        parts.join(triangle[0], triangle[2]);
    }
    constexpr std::uint32_t unnumbered = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> numbers(mesh.vertices.size(), unnumbered);
    Components components;
    components.of_triangle.reserve(mesh.triangles.size());
    for (const Triangle& triangle : mesh.triangles) {
        std::uint32_t& number = numbers[parts.root(triangle[0])];
        if (number == unnumbered) number = static_cast<std::uint32_t>(components.count++);
        components.of_triangle.push_back(number);
    }
    return components;
}

bool is_flat(const SurfaceMesh& mesh, const Triangle& triangle)
{
    const Vec3d a = to_double(mesh.vertices[triangle[0]]), b = to_double(mesh.vertices[triangle[1]]),
                c = to_double(mesh.vertices[triangle[2]]);
    const Vec3d normal = cross(b - a, c - a);
    double coordinate = 0, longest = 0;
    for (const Vec3d v : {a, b, c})
        coordinate = std::max({coordinate, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    for (const Vec3d side : {b - a, c - b, a - c}) longest = std::max(longest, std::sqrt(dot(side, side)));
    return std::sqrt(dot(normal, normal)) <= longest * coordinate * std::numeric_limits<float>::epsilon();
}

void require_valid(const SurfaceMesh& mesh)
{
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vec3 v = mesh.vertices[i];
        for (const float value : {v.x, v.y, v.z})
            if (!std::isfinite(value))
                throw Error(ErrorKind::bad_input, "vertex " + std::to_string(i) +
                                                      " of the mesh has the coordinate " +
                                                      number_text(value) + "; coordinates must be finite");
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::uint32_t index : mesh.triangles[i])
            if (index >= mesh.vertices.size())
                throw Error(ErrorKind::bad_input, "triangle " + std::to_string(i) +
                                                      " of the mesh uses vertex " + std::to_string(index) +
                                                      ", but there are only " +
                                                      std::to_string(mesh.vertices.size()) + " vertices");
}

}  // namespace pliant
