// The icosphere: points on the edges and faces of an icosahedron, projected onto the sphere. Points divide
// the arcs evenly, not the chords, which keeps the triangles nearly equal.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "mesh/generator_options.hpp"
#include "pliant/mesh_generators.hpp"

namespace pliant {
namespace {

constexpr double golden = 1.618033988749894848;  // (1 + sqrt 5) / 2

constexpr std::array<Vec3d, 12> icosahedron = {{{0, 1, golden},
                                                {0, -1, golden},
                                                {0, 1, -golden},
                                                {0, -1, -golden},
                                                {1, golden, 0},
                                                {-1, golden, 0},
                                                {1, -golden, 0},
                                                {-1, -golden, 0},
                                                {golden, 0, 1},
                                                {-golden, 0, 1},
                                                {golden, 0, -1},
                                                {-golden, 0, -1}}};

Vec3d unit(Vec3d v) { return v * (1 / std::sqrt(dot(v, v))); }

/// The point at a fraction t of the arc from a to b, two unit vectors.
Vec3d on_arc(Vec3d a, Vec3d b, double t)
{
    const double angle = std::acos(std::clamp(dot(a, b), -1.0, 1.0));
    return unit(a * std::sin((1 - t) * angle) + b * std::sin(t * angle));
}

/// The 20 triples of corners that are an edge's length apart, facing outward.
std::vector<Triangle> icosahedron_faces()
{
    constexpr double edge = 4;  // squared, of `icosahedron`
    const auto near = [](std::uint32_t i, std::uint32_t j) {
        const Vec3d d = icosahedron[i] - icosahedron[j];
        return std::abs(dot(d, d) - edge) < 0.5;
    };
    std::vector<Triangle> faces;
    for (std::uint32_t i = 0; i < 12; ++i)
        for (std::uint32_t j = i + 1; j < 12; ++j)
            for (std::uint32_t k = j + 1; k < 12; ++k) {
                if (!near(i, j) || !near(j, k) || !near(k, i)) continue;
                const bool outward = dot(icosahedron[i], cross(icosahedron[j], icosahedron[k])) > 0;
                faces.push_back(outward ? Triangle{i, j, k} : Triangle{i, k, j});
            }
    return faces;
}

class Icosphere {
public:
    explicit Icosphere(const IcosphereOptions& options) : radius_(options.radius), f_(options.frequency)
    {
        for (const Vec3d corner : icosahedron) add(unit(corner));
        for (const Triangle& face : icosahedron_faces()) add_face(face);
    }
    SurfaceMesh take() { return std::move(mesh_); }

private:
    std::uint32_t add(Vec3d direction)
    {
        mesh_.vertices.push_back(to_float(direction * radius_));
        return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
    }

    /// The vertex `step` parts along the edge from a to b; an edge's vertices are created when it first
    /// occurs.
    std::uint32_t on_edge(std::uint32_t a, std::uint32_t b, std::uint32_t step)
    {
        if (step == 0) return a;
        if (step == f_) return b;
        const auto [low, high] = std::minmax(a, b);
        const auto [found, is_new] = edges_.try_emplace({low, high}, std::uint32_t(mesh_.vertices.size()));
        if (is_new)
            for (std::uint32_t i = 1; i < f_; ++i)
                add(on_arc(unit(icosahedron[low]), unit(icosahedron[high]), double(i) / f_));
        return found->second + (a < b ? step : f_ - step) - 1;
    }

    /// Row by row from corner 0: row i has i + 1 vertices, from the edge 0-1 to the edge 0-2.
    void add_face(const Triangle& face)
    {
        const auto [a, b, c] = face;
        std::vector<std::uint32_t> above = {a}, row;
        for (std::uint32_t i = 1; i <= f_; ++i) {
            row.clear();
            for (std::uint32_t j = 0; j <= i; ++j)
                row.push_back(j == 0    ? on_edge(a, b, i)
                              : j == i  ? on_edge(a, c, i)
                              : i == f_ ? on_edge(b, c, j)
                                        : add(inner(face, i, j)));
            for (std::uint32_t j = 0; j < i; ++j) {
                mesh_.triangles.push_back({above[j], row[j], row[j + 1]});
                if (j + 1 < i) mesh_.triangles.push_back({above[j], row[j + 1], above[j + 1]});
            }
            above = row;
        }
    }

    /// The mean of three ways to divide: along the arcs parallel to each side.
    Vec3d inner(const Triangle& face, std::uint32_t i, std::uint32_t j) const
    {
        const std::array<Vec3d, 3> corner = {unit(icosahedron[face[0]]), unit(icosahedron[face[1]]),
                                             unit(icosahedron[face[2]])};
        const std::array<double, 3> weight = {double(f_ - i) / f_, double(i - j) / f_, double(j) / f_};
        Vec3d sum;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
            const double away = 1 - weight[k];
            sum = sum + on_arc(on_arc(corner[k], corner[l], away), on_arc(corner[k], corner[m], away),
                               weight[m] / away);
        }
        return unit(sum);
    }

    double radius_;
    std::uint32_t f_;
    SurfaceMesh mesh_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges_;  // the first inner vertex of
                                                                              // each edge
};

}  // namespace

SurfaceMesh icosphere_mesh(const IcosphereOptions& options)
{
    require_length("icosphere.radius", options.radius);
    require_count("icosphere.frequency", options.frequency, 1, 1024);
    return Icosphere(options).take();
}

}  // namespace pliant
