// inspect_mesh. The mesh is judged as stored: nothing is welded, dropped or turned.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>

#include "mesh/mesh_orientation.hpp"
#include "mesh/mesh_topology.hpp"

namespace pliant {

namespace {

/// Classifies edges by the number of their triangles; checks directions and lengths.
void inspect_edges(const SurfaceMesh& mesh, std::span<const EdgeUse> uses, MeshReport& report)
{
    report.oriented = !mesh.triangles.empty();
    report.edge_min = uses.empty() ? 0 : std::numeric_limits<double>::infinity();
    double length_sum = 0;
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
        ++report.edges;
        if (edge.size() == 1) ++report.boundary_edges;
        if (edge.size() == 2 && edge[0].goes_up(mesh) == edge[1].goes_up(mesh)) {
            if (report.oriented) report.first_disagreement = edge[0].low;
            report.oriented = false;
        }
        if (edge.size() > 2 && report.non_manifold_edges++ == 0)
            report.first_non_manifold_edge = {edge[0].low, edge[0].high};

        const double length = edge_length(mesh, edge[0]);
        report.edge_min = std::min(report.edge_min, length);
        report.edge_max = std::max(report.edge_max, length);
        length_sum += length;
    });
    if (report.edges > 0) report.edge_mean = length_sum / static_cast<double>(report.edges);
}

/// A fan is a set of triangle corners at one vertex, each sharing an edge with another.
void inspect_fans(const SurfaceMesh& mesh, std::span<const EdgeUse> uses, MeshReport& report)
{
    const std::size_t corner_count = 3 * mesh.triangles.size();
    const auto corner_at = [&](std::size_t triangle, std::uint32_t vertex) {
        const auto& corners = mesh.triangles[triangle];
        return 3 * triangle + static_cast<std::size_t>(std::ranges::find(corners, vertex) - corners.begin());
    };
    DisjointSets fans(corner_count);
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
        for (const EdgeUse& use : edge.subspan(1))
            for (const std::uint32_t vertex : {use.low, use.high})
                fans.join(corner_at(edge[0].corner / 3, vertex), corner_at(use.corner / 3, vertex));
    });

    std::vector<bool> one_fan(mesh.vertices.size()), more_fans(mesh.vertices.size());
    for (std::size_t corner = 0; corner < corner_count; ++corner) {
        const std::uint32_t vertex = mesh.triangles[corner / 3][corner % 3];
        // (a, a, b) has two corners at a, which count as one.
        if (!fans.is_root(corner) || corner != corner_at(corner / 3, vertex)) continue;
        if (one_fan[vertex]) more_fans[vertex] = true;
        one_fan[vertex] = true;
    }
    report.non_manifold_vertices = static_cast<std::size_t>(std::ranges::count(more_fans, true));
    if (report.non_manifold_vertices > 0)
        report.first_non_manifold_vertex =
            static_cast<std::uint32_t>(std::ranges::find(more_fans, true) - more_fans.begin());
}

/// Isolated and coincident vertices, Euler characteristic.
void inspect_vertices(const SurfaceMesh& mesh, MeshReport& report)
{
    std::vector<bool> used(mesh.vertices.size());
    for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t index : triangle) used[index] = true;
    const auto used_count = static_cast<std::size_t>(std::ranges::count(used, true));
    report.isolated_vertices = report.vertices - used_count;
    report.euler_characteristic = static_cast<long long>(used_count) - static_cast<long long>(report.edges) +
                                  static_cast<long long>(report.triangles);

    std::vector<Vec3> sorted = mesh.vertices;
    const auto key = [](const Vec3& v) { return std::tuple(v.x, v.y, v.z); };
    std::ranges::sort(sorted, {}, key);
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i] == sorted[i - 1]) ++report.coincident_vertices;
}

void inspect_duplicates(const SurfaceMesh& mesh, MeshReport& report)
{
    std::vector<Triangle> sorted = mesh.triangles;
    for (Triangle& triangle : sorted) std::ranges::sort(triangle);
    std::ranges::sort(sorted);
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i] == sorted[i - 1]) ++report.duplicate_triangles;
}

/// Bounds, area, volume and degenerate triangles.
void measure(const SurfaceMesh& mesh, MeshReport& report)
{
    if (mesh.vertices.empty()) return;
    report.bounds_min = report.bounds_max = to_double(mesh.vertices[0]);
    for (const Vec3 vertex : mesh.vertices) {
        const Vec3d v = to_double(vertex);
        Vec3d &low = report.bounds_min, &high = report.bounds_max;
        low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
        high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }

    if (mesh.triangles.empty()) return;
    // V = 1/6 sum a . (b x c), about a point of the surface: far from the origin the terms would cancel.
    const Vec3d origin = to_double(mesh.vertices[mesh.triangles[0][0]]);
    for (const Triangle& triangle : mesh.triangles) {
        const Vec3d a = to_double(mesh.vertices[triangle[0]]), b = to_double(mesh.vertices[triangle[1]]),
                    c = to_double(mesh.vertices[triangle[2]]);
        const Vec3d normal = cross(b - a, c - a);
        report.area += std::sqrt(dot(normal, normal)) / 2;
        report.volume += volume6(mesh, triangle, origin) / 6;
        if (has_repeated_vertex(triangle) || is_flat(mesh, triangle)) ++report.degenerate_triangles;
    }
}

}  // namespace

MeshReport inspect_mesh(const SurfaceMesh& mesh)
{
    require_valid(mesh);
    MeshReport report;
    report.vertices = mesh.vertices.size();
    report.triangles = mesh.triangles.size();
    const std::vector<EdgeUse> uses = edge_uses(mesh);
    inspect_edges(mesh, uses, report);
    report.loops = boundary_loops(mesh, uses);
    report.boundary_loops = report.loops.size();
    inspect_fans(mesh, uses, report);
    report.closed = report.triangles > 0 && report.boundary_edges == 0 && report.non_manifold_edges == 0 &&
                    report.non_manifold_vertices == 0;
    inspect_vertices(mesh, report);
    report.components = components_of(mesh).count;
    inspect_duplicates(mesh, report);
    measure(mesh, report);
    const OrientationPlan plan = plan_orientation(mesh, uses);
    report.orientable = plan.orientable;
    report.inward_components = plan.inward_components;
    if (report.closed && report.orientable)
        report.genus = static_cast<long long>(report.components) - report.euler_characteristic / 2;
    return report;
}

}  // namespace pliant
