// inspect_mesh and describe. The mesh is judged as stored: nothing is welded, dropped or turned round.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>

#include "mesh/mesh_formats.hpp"

namespace pliant {

namespace {

/// Disjoint sets of 0 .. n-1, with path halving.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t n) : parents_(n)
    {
        std::iota(parents_.begin(), parents_.end(), std::size_t{0});
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

/// One side of a triangle, from the triangle's corner `side` to the next one.
struct EdgeUse {
    std::uint32_t low, high;  // the two vertices
    std::size_t corner;       // 3 * triangle + side

    bool same_edge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

bool has_repeated_vertex(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// All sides, those of one edge together. A triangle (a, a, b) uses the edge a-b once.
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

/// Calls `visit` with the uses of each edge.
template <class Visit>
void for_each_edge(std::span<const EdgeUse> uses, Visit visit)
{
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
        while (end < uses.size() && uses[end].same_edge(uses[begin])) ++end;
        visit(uses.subspan(begin, end - begin));
    }
}

/// Edges by the number of their triangles, their direction and length.
void inspect_edges(const SurfaceMesh& mesh, std::span<const EdgeUse> uses, MeshReport& report)
{
    const auto start = [&](const EdgeUse& use) { return mesh.triangles[use.corner / 3][use.corner % 3]; };
    report.oriented = !mesh.triangles.empty();
    report.edge_min = uses.empty() ? 0 : std::numeric_limits<double>::infinity();
    double length_sum = 0;
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
        ++report.edges;
        if (edge.size() == 1) ++report.boundary_edges;
        if (edge.size() == 2 && start(edge[0]) == start(edge[1])) report.oriented = false;
        if (edge.size() > 2) ++report.non_manifold_edges;

        const Vec3d along = to_double(mesh.vertices[edge[0].high]) - to_double(mesh.vertices[edge[0].low]);
        const double length = std::sqrt(dot(along, along));
        report.edge_min = std::min(report.edge_min, length);
        report.edge_max = std::max(report.edge_max, length);
        length_sum += length;
    });
    if (report.edges > 0) report.edge_mean = length_sum / static_cast<double>(report.edges);
}

std::size_t boundary_loop_count(const SurfaceMesh& mesh, std::span<const EdgeUse> uses)
{
    DisjointSets chains(mesh.vertices.size());
    std::vector<bool> on_boundary(mesh.vertices.size());
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
        if (edge.size() != 1) return;
        chains.join(edge[0].low, edge[0].high);
        on_boundary[edge[0].low] = on_boundary[edge[0].high] = true;
    });
    std::size_t count = 0;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        if (on_boundary[i] && chains.is_root(i)) ++count;
    return count;
}

/// A fan is a set of triangle corners at one vertex, each sharing an edge with another.
std::size_t non_manifold_vertex_count(const SurfaceMesh& mesh, std::span<const EdgeUse> uses)
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
        // The two corners that (a, a, b) has at a are one.
        if (!fans.is_root(corner) || corner != corner_at(corner / 3, vertex)) continue;
        if (one_fan[vertex]) more_fans[vertex] = true;
        one_fan[vertex] = true;
    }
    return static_cast<std::size_t>(std::ranges::count(more_fans, true));
}

/// Isolated and coincident vertices, components, Euler characteristic.
void inspect_vertices(const SurfaceMesh& mesh, MeshReport& report)
{
    std::vector<bool> used(mesh.vertices.size());
    DisjointSets parts(mesh.vertices.size());
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t index : triangle) used[index] = true;
        parts.join(triangle[0], triangle[1]);
        parts.join(triangle[0], triangle[2]);
    }
    std::size_t used_count = 0;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        if (!used[i]) continue;
        ++used_count;
        if (parts.is_root(i)) ++report.components;
    }
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

/// Whether the triangle is no higher than the rounding of its float coordinates.
bool is_flat(Vec3d a, Vec3d b, Vec3d c, double doubled_area)
{
    double coordinate = 0, longest = 0;
    for (const Vec3d v : {a, b, c})
        coordinate = std::max({coordinate, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    for (const Vec3d side : {b - a, c - b, a - c}) longest = std::max(longest, std::sqrt(dot(side, side)));
    return doubled_area <= longest * coordinate * std::numeric_limits<float>::epsilon();
}

/// Bounds, area, volume and triangles without area.
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
        const double doubled_area = std::sqrt(dot(normal, normal));
        report.area += doubled_area / 2;
        report.volume += dot(a - origin, cross(b - origin, c - origin)) / 6;
        if (has_repeated_vertex(triangle) || is_flat(a, b, c, doubled_area)) ++report.degenerate_triangles;
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
    report.boundary_loops = boundary_loop_count(mesh, uses);
    report.non_manifold_vertices = non_manifold_vertex_count(mesh, uses);
    report.closed = report.triangles > 0 && report.boundary_edges == 0 && report.non_manifold_edges == 0 &&
                    report.non_manifold_vertices == 0;
    inspect_vertices(mesh, report);
    inspect_duplicates(mesh, report);
    measure(mesh, report);
    return report;
}

namespace {

/// Six digits, as a person reads them.
std::string rounded(double value)
{
    std::array<char, 32> digits;
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 6);
    return {digits.data(), end.ptr};
}

std::string rounded(Vec3d v) { return "(" + rounded(v.x) + ", " + rounded(v.y) + ", " + rounded(v.z) + ")"; }

std::string counted(std::size_t count, const std::string& one, const std::string& many)
{
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

std::string describe(const MeshReport& report)
{
    std::string text = counted(report.vertices, "vertex", "vertices") + ", " +
                       counted(report.edges, "edge", "edges") + ", " +
                       counted(report.triangles, "triangle", "triangles") + " in " +
                       counted(report.components, "component", "components") + "\n";
    if (report.triangles > 0) {
        text += std::string("surface: ") + (report.closed ? "closed" : "not closed") + ", " +
                (report.oriented ? "consistently oriented" : "not consistently oriented") +
                ", Euler characteristic " + std::to_string(report.euler_characteristic) + "\n";
        text += "area: " + rounded(report.area) + " m^2\n";
        if (report.closed && report.oriented) {
            text += "volume: " + rounded(report.volume) + " m^3";
            text += report.volume < 0 ? " (negative: the surface is inside out)\n" : "\n";
        }
        text += "edge length: " + rounded(report.edge_min) + " to " + rounded(report.edge_max) + " m, mean " +
                rounded(report.edge_mean) + " m\n";
    }
    text += "bounds: " + rounded(report.bounds_min) + " to " + rounded(report.bounds_max) + " m\n";

    const auto remark = [&](std::size_t count, const char* one, const char* many) {
        if (count > 0) text += counted(count, one, many) + "\n";
    };
    remark(report.boundary_edges, "boundary edge", "boundary edges");
    remark(report.boundary_loops, "boundary loop", "boundary loops");
    remark(report.non_manifold_edges, "non-manifold edge (three or more triangles)",
           "non-manifold edges (three or more triangles)");
    remark(report.non_manifold_vertices, "non-manifold vertex (more than one fan)",
           "non-manifold vertices (more than one fan)");
    remark(report.degenerate_triangles, "degenerate triangle (a vertex twice, or no area)",
           "degenerate triangles (a vertex twice, or no area)");
    remark(report.duplicate_triangles, "duplicate triangle", "duplicate triangles");
    remark(report.coincident_vertices, "vertex at the position of another",
           "vertices at the position of another");
    remark(report.isolated_vertices, "vertex used by no triangle", "vertices used by no triangle");
    return text;
}

}  // namespace pliant
