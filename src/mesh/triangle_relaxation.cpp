#include "mesh/triangle_relaxation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace pliant {
namespace {

/// The nearest point of the zero surface, to second order.
Vec3d projected(Vec3d point, Field field, double furthest)
{
    const FieldSample sample = field(point);
    const double steep = dot(sample.gradient, sample.gradient);
    if (!(steep > 0)) return point;
    const double step = std::clamp(sample.value / steep, -furthest, furthest);
    return point - sample.gradient * step;
}

/// Moves each vertex towards the area centroid of its triangles, which equalises their areas.
void smooth(std::vector<Vec3d>& points, const std::vector<Triangle>& triangles, Field field, double spacing)
{
    constexpr double towards = 0.8;  // more would overshoot, since neighbours move, too
    std::vector<Vec3d> sums(points.size());
    std::vector<double> areas(points.size());
    for (const Triangle& t : triangles) {
        const Vec3d a = points[t[0]], b = points[t[1]], c = points[t[2]];
        const Vec3d normal = cross(b - a, c - a);
        const double area = std::sqrt(dot(normal, normal));
        const Vec3d weighted = (a + b + c) * (area / 3);
        for (const std::uint32_t vertex : t) {
            sums[vertex] = sums[vertex] + weighted;
            areas[vertex] += area;
        }
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!(areas[i] > 0)) continue;
        const Vec3d way = sums[i] * (1 / areas[i]) - points[i];
        const Vec3d normal = field(points[i]).gradient;
        const double steep = dot(normal, normal);
        const Vec3d along = steep > 0 ? way - normal * (dot(way, normal) / steep) : way;
        points[i] = projected(points[i] + along * towards, field, spacing / 2);
    }
}

/// An edge between two triangles; the corners are 3 * triangle + the corner opposite the edge.
struct SharedEdge {
    std::uint32_t low, high;
    std::size_t corner;

    friend bool operator<(const SharedEdge& a, const SharedEdge& b)
    {
        return std::tuple(a.low, a.high, a.corner) < std::tuple(b.low, b.high, b.corner);
    }
};

double cotangent(Vec3d tip, Vec3d a, Vec3d b)
{
    const Vec3d u = a - tip, v = b - tip, across = cross(u, v);
    return dot(u, v) / std::sqrt(std::max(dot(across, across), 1e-300));
}

/// One pass over the edges: flips each edge whose opposite angles sum to more than 180 degrees (Bern and
/// Plassmann: the flip to Delaunay). Returns the number of flips.
std::size_t flip_edges(std::vector<Triangle>& triangles, const std::vector<Vec3d>& points)
{
    std::vector<SharedEdge> sides;
    sides.reserve(3 * triangles.size());
    std::vector<std::uint32_t> valence(points.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(triangles[t][(k + 1) % 3], triangles[t][(k + 2) % 3]);
            sides.push_back({low, high, 3 * t + k});
            ++valence[triangles[t][k]];
        }
    std::sort(sides.begin(), sides.end());
    const auto joined = [&](std::uint32_t a, std::uint32_t b) {
        const SharedEdge key{std::min(a, b), std::max(a, b), 0};
        const auto found = std::lower_bound(sides.begin(), sides.end(), key);
        return found != sides.end() && found->low == key.low && found->high == key.high;
    };

    std::size_t flips = 0;
    std::vector<bool> changed(triangles.size());
    std::set<std::pair<std::uint32_t, std::uint32_t>> made;
    for (std::size_t e = 0; e + 1 < sides.size(); e += 2) {  // two sides per edge, since the mesh is closed
        const std::size_t first = sides[e].corner / 3, second = sides[e + 1].corner / 3;
        if (changed[first] || changed[second]) continue;
        const std::size_t k = sides[e].corner % 3;
        const std::uint32_t tip = triangles[first][k], from = triangles[first][(k + 1) % 3],
                            to = triangles[first][(k + 2) % 3],
                            other = triangles[second][sides[e + 1].corner % 3];
        if (valence[from] <= 4 || valence[to] <= 4 || joined(tip, other)) continue;
        const double sum = cotangent(points[tip], points[from], points[to]) +
                           cotangent(points[other], points[from], points[to]);
        if (sum > -1e-9 || !made.insert(std::minmax(tip, other)).second) continue;
        triangles[first] = {tip, from, other};
        triangles[second] = {tip, other, to};
        changed[first] = changed[second] = true;
        --valence[from], --valence[to], ++valence[tip], ++valence[other];
        ++flips;
    }
    return flips;
}

}  // namespace

void relax_triangles(SurfaceMesh& mesh, Field field, double spacing)
{
    std::vector<Vec3d> points;
    points.reserve(mesh.vertices.size());
    for (const Vec3 vertex : mesh.vertices) points.push_back(projected(to_double(vertex), field, spacing));
    constexpr int rounds = 4, sweeps = 5;
    for (int round = 0; round < rounds; ++round) {
        for (int sweep = 0; sweep < sweeps; ++sweep) smooth(points, mesh.triangles, field, spacing);
        for (int pass = 0; pass < 10 && flip_edges(mesh.triangles, points) > 0; ++pass) {
        }
    }
    for (Vec3d& point : points) point = projected(point, field, spacing);
    for (std::size_t i = 0; i < points.size(); ++i) mesh.vertices[i] = to_float(points[i]);
}

}  // namespace pliant
