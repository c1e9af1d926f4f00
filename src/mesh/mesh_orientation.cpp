#include "mesh/mesh_orientation.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace pliant {
namespace {

/// A component after its triangles agree.
struct Part {
    std::vector<std::size_t> triangles;
    bool closed = true, orientable = true;
    double volume = 0;  // m^3, signed, about its own middle
    double area = 0;    // m^2
    Vec3d low, high;    // bounds, m
    std::size_t turned = 0;
};

Vec3d least(Vec3d a, Vec3d b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3d most(Vec3d a, Vec3d b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

class Orienter {
public:
    Orienter(const SurfaceMesh& mesh, std::span<const EdgeUse> uses)
        : mesh_(mesh), uses_(uses), turn_(mesh.triangles.size())
    {
    }

    OrientationPlan plan()
    {
        make_parts();
        OrientationPlan plan;
        plan.orientable = !mesh_.triangles.empty();
        for (Part& part : parts_) {
            measure(part);
            plan.orientable = plan.orientable && part.orientable;
        }
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const Part& part = parts_[i];
            if (!part.orientable) continue;
            bool reverse = 2 * part.turned > part.triangles.size();
            if (part.closed && std::abs(part.volume) > flat_volume(part.area)) {
                reverse = (part.volume < 0) != is_cavity(i);
                const bool agrees = part.turned == 0 || part.turned == part.triangles.size();
                if (agrees && reverse == (part.turned == 0)) ++plan.inward_components;
            }
            if (reverse)
                for (const std::size_t t : part.triangles) turn_[t] = !turn_[t];
        }
        plan.turn = std::move(turn_);
        return plan;
    }

private:
    /// Neighbour triangles across each edge with two triangles, then a flood fill from the first triangle of
    /// each part. Parts are connected by such edges: triangles that share only a vertex need not agree.
    void make_parts()
    {
        constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
        std::vector<std::array<std::size_t, 3>> across(mesh_.triangles.size(), {none, none, none});
        std::vector<bool> open(mesh_.triangles.size());
        for_each_edge(uses_, [&](std::span<const EdgeUse> edge) {
            if (edge.size() == 2) {
                across[edge[0].triangle()][edge[0].corner % 3] = edge[1].corner;
                across[edge[1].triangle()][edge[1].corner % 3] = edge[0].corner;
            } else {
                for (const EdgeUse& use : edge) open[use.triangle()] = true;
            }
        });
        std::vector<bool> seen(mesh_.triangles.size());
        for (std::size_t seed = 0; seed < mesh_.triangles.size(); ++seed) {
            if (seen[seed]) continue;
            Part& part = parts_.emplace_back();
            part.triangles.push_back(seed);
            seen[seed] = true;
            for (std::size_t i = 0; i < part.triangles.size(); ++i) {
                const std::size_t t = part.triangles[i];
                if (open[t]) part.closed = false;
                for (std::size_t side = 0; side < 3; ++side) {
                    const std::size_t other = across[t][side];
                    if (other == none) continue;
                    const bool turned = turn_[t] != (start(3 * t + side) == start(other));
                    if (!seen[other / 3]) {
                        seen[other / 3] = true;
                        turn_[other / 3] = turned;
                        part.triangles.push_back(other / 3);
                    } else if (turn_[other / 3] != turned) {
                        part.orientable = false;
                    }
                }
            }
            for (const std::size_t t : part.triangles) part.turned += turn_[t];
        }
    }

    std::uint32_t start(std::size_t corner) const { return mesh_.triangles[corner / 3][corner % 3]; }

    void measure(Part& part) const
    {
        part.low = part.high = to_double(mesh_.vertices[mesh_.triangles[part.triangles[0]][0]]);
        for (const std::size_t t : part.triangles)
            for (const std::uint32_t vertex : mesh_.triangles[t]) {
                part.low = least(part.low, to_double(mesh_.vertices[vertex]));
                part.high = most(part.high, to_double(mesh_.vertices[vertex]));
            }
        // About the middle: far from the origin the terms would cancel.
        const Vec3d middle = (part.low + part.high) * 0.5;
        for (const std::size_t t : part.triangles) {
            const Triangle& triangle = mesh_.triangles[t];
            const Vec3d a = to_double(mesh_.vertices[triangle[0]]),
                        normal = cross(to_double(mesh_.vertices[triangle[1]]) - a,
                                       to_double(mesh_.vertices[triangle[2]]) - a);
            part.area += std::sqrt(dot(normal, normal)) / 2;
            part.volume += volume6(mesh_, triangle, middle) / (turn_[t] ? -6 : 6);
        }
    }

    /// Whether the part is inside an odd number of closed parts.
    bool is_cavity(std::size_t i) const
    {
        const Part& part = parts_[i];
        std::size_t around = 0;
        for (std::size_t j = 0; j < parts_.size(); ++j)
            if (j != i && parts_[j].closed && parts_[j].orientable && contains(parts_[j], part)) ++around;
        return around % 2 == 1;
    }

    /// Tests the bounds, then three vertices of the inner part: overlapping parts do not contain each other.
    bool contains(const Part& outer, const Part& inner) const
    {
        const bool bounds_inside = least(outer.low, inner.low) == outer.low &&
                                   most(outer.high, inner.high) == outer.high && outer.area > inner.area;
        if (!bounds_inside) return false;
        const std::size_t n = inner.triangles.size();
        for (const std::size_t k : {std::size_t{0}, n / 3, 2 * n / 3}) {
            const Vec3d point = to_double(mesh_.vertices[mesh_.triangles[inner.triangles[k]][0]]);
            if (std::abs(winding_number(outer, point)) < 0.5) return false;
        }
        return true;
    }

    /// The winding number of the part about the point: the sum of solid angles over 4 pi (van Oosterom and
    /// Strackee, The Solid Angle of a Plane Triangle, 1983).
    double winding_number(const Part& part, Vec3d point) const
    {
        double sum = 0;
        for (const std::size_t t : part.triangles) {
            const Triangle& triangle = mesh_.triangles[t];
            std::array<Vec3d, 3> way;
            std::array<double, 3> length{};
            for (std::size_t k = 0; k < 3; ++k) {
                way[k] = to_double(mesh_.vertices[triangle[k]]) - point;
                length[k] = std::sqrt(dot(way[k], way[k]));
            }
            const double above = dot(way[0], cross(way[1], way[2]));
            const double below = length[0] * length[1] * length[2] + dot(way[0], way[1]) * length[2] +
                                 dot(way[1], way[2]) * length[0] + dot(way[2], way[0]) * length[1];
            sum += 2 * std::atan2(above, below) * (turn_[t] ? -1 : 1);
        }
        return sum / (4 * std::numbers::pi);
    }

    const SurfaceMesh& mesh_;
    std::span<const EdgeUse> uses_;
    std::vector<bool> turn_;
    std::vector<Part> parts_;
};

}  // namespace

OrientationPlan plan_orientation(const SurfaceMesh& mesh, std::span<const EdgeUse> uses)
{
    return Orienter(mesh, uses).plan();
}

std::size_t turn_triangles(SurfaceMesh& mesh, const std::vector<bool>& turn)
{
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!turn[t]) continue;
        std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
        ++count;
    }
    return count;
}

}  // namespace pliant
