// The triangulation of least area follows Barequet and Sharir, Filling Gaps in the Boundary of a Polyhedron,
// 1995. Here long edges get a small additional weight, which decides between equal areas (a flat hole), and
// triangles without area or with existing edges are excluded.
#include "mesh/hole_filling.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "mesh/mesh_topology.hpp"

namespace pliant {
namespace {

using Loop = std::vector<std::uint32_t>;

constexpr std::size_t no_side = std::numeric_limits<std::size_t>::max();
constexpr std::size_t longest_loop = 400;  // the time grows with its cube: 10 million triangles are tested

std::size_t previous_corner(std::size_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

/// The loops around the holes, in the direction that their triangles need.
class LoopFinder {
public:
    LoopFinder(const SurfaceMesh& mesh, std::span<const EdgeUse> uses)
        : mesh_(mesh), across_(3 * mesh.triangles.size(), barrier)
    {
        for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
            if (edge.size() == 1) {
                across_[edge[0].corner] = boundary;
                starts_.push_back(edge[0].corner);
            } else if (edge.size() == 2 && edge[0].goes_up(mesh) != edge[1].goes_up(mesh)) {
                across_[edge[0].corner] = edge[1].corner;
                across_[edge[1].corner] = edge[0].corner;
            }
        });
    }

    std::vector<Loop> loops() const
    {
        std::vector<Loop> loops;
        std::vector<bool> done(across_.size());
        for (const std::size_t start : starts_) {
            if (done[start]) continue;
            Loop loop;
            std::size_t side = start;
            do {
                done[side] = true;
                loop.push_back(vertex(side));
                side = next(side);
            } while (side != no_side && !done[side]);
            if (side == start) split(loop, loops);
        }
        return loops;
    }

private:
    static constexpr std::size_t boundary = no_side, barrier = no_side - 1;

    std::uint32_t vertex(std::size_t corner) const { return mesh_.triangles[corner / 3][corner % 3]; }

    /// The next boundary side around the same fan, ending where this side begins; none if the fan is blocked.
    std::size_t next(std::size_t side) const
    {
        for (std::size_t steps = 0; steps < across_.size(); ++steps) {
            side = previous_corner(side);
            if (across_[side] == boundary) return side;
            if (across_[side] == barrier) return no_side;
            side = across_[side];
        }
        return no_side;
    }

    /// Splits a loop that passes a vertex twice into two loops.
    static void split(const Loop& loop, std::vector<Loop>& loops)
    {
        Loop open;
        for (const std::uint32_t vertex : loop) {
            const auto again = std::ranges::find(open, vertex);
            if (again != open.end()) {
                loops.emplace_back(again, open.end());
                open.erase(again, open.end());
            }
            open.push_back(vertex);
        }
        loops.push_back(std::move(open));
    }

    const SurfaceMesh& mesh_;
    std::vector<std::size_t> across_;  // by side: the neighbour's side, or a marker
    std::vector<std::size_t> starts_;
};

class HoleFiller {
public:
    HoleFiller(SurfaceMesh& mesh, std::span<const EdgeUse> uses) : mesh_(mesh)
    {
        for (const EdgeUse& use : uses) edges_.emplace(use.low, use.high);
    }

    void fill(const Loop& loop)
    {
        if (loop.size() > longest_loop || !triangulate(loop)) fan(loop);
        ++filling_.holes;
    }
    HoleFilling filling() const { return filling_; }

private:
    Vec3d at(std::uint32_t vertex) const { return to_double(mesh_.vertices[vertex]); }

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c)
    {
        mesh_.triangles.push_back({a, b, c});
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
            edges_.insert(std::minmax(from, to));
        ++filling_.triangles;
    }

    /// m^2, or infinity for an excluded triangle
    double weight(const Triangle& t) const
    {
        if (is_flat(mesh_, t)) return std::numeric_limits<double>::infinity();
        const Vec3d a = at(t[1]) - at(t[0]), b = at(t[2]) - at(t[1]), c = at(t[0]) - at(t[2]),
                    normal = cross(a, b);
        constexpr double of_edges = 0.01;
        return std::sqrt(dot(normal, normal)) / 2 + of_edges * (dot(a, a) + dot(b, b) + dot(c, c));
    }

    /// best[i][j]: the least weight of a triangulation between the vertices i to j of the loop and the edge
    /// j-i.
    bool triangulate(const Loop& loop)
    {
        const std::size_t n = loop.size();
        constexpr double never = std::numeric_limits<double>::infinity();
        std::vector<double> best(n * n, 0);
        std::vector<std::size_t> tip(n * n, no_side);
        for (std::size_t span = 2; span < n; ++span)
            for (std::size_t i = 0; i + span < n; ++i) {
                const std::size_t j = i + span;
                double& least = best[i * n + j];
                least = never;
                const bool rim = i == 0 && j == n - 1;  // an edge of the loop itself
                if (!rim && edges_.contains(std::minmax(loop[i], loop[j]))) continue;
                for (std::size_t k = i + 1; k < j; ++k) {
                    const double before = best[i * n + k] + best[k * n + j];
                    if (before >= least) continue;
                    const double sum = before + weight({loop[i], loop[k], loop[j]});
                    if (sum >= least) continue;
                    least = sum;
                    tip[i * n + j] = k;
                }
            }
        if (!(best[n - 1] < never)) return false;
        std::vector<std::pair<std::size_t, std::size_t>> open = {{0, n - 1}};
        while (!open.empty()) {
            const auto [i, j] = open.back();
            open.pop_back();
            if (j - i < 2) continue;
            const std::size_t k = tip[i * n + j];
            add(loop[i], loop[k], loop[j]);
            open.emplace_back(i, k);
            open.emplace_back(k, j);
        }
        return true;
    }

    /// A fan about the middle of the loop.
    void fan(const Loop& loop)
    {
        Vec3d sum;
        double whole = 0;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec3d a = at(loop[i]), b = at(loop[(i + 1) % loop.size()]), way = b - a;
            const double length = std::sqrt(dot(way, way));
            sum = sum + (a + b) * (length / 2);
            whole += length;
        }
        const auto middle = static_cast<std::uint32_t>(mesh_.vertices.size());
        mesh_.vertices.push_back(whole > 0 ? to_float(sum * (1 / whole)) : mesh_.vertices[loop[0]]);
        ++filling_.vertices;
        for (std::size_t i = 0; i < loop.size(); ++i) add(loop[i], loop[(i + 1) % loop.size()], middle);
    }

    SurfaceMesh& mesh_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges_;
    HoleFilling filling_;
};

}  // namespace

HoleFilling fill_holes(SurfaceMesh& mesh)
{
    const std::vector<EdgeUse> uses = edge_uses(mesh);
    const std::vector<Loop> loops = LoopFinder(mesh, uses).loops();
    if (loops.empty()) return {};
    HoleFiller filler(mesh, uses);
    for (const Loop& loop : loops) filler.fill(loop);
    return filler.filling();
}

}  // namespace pliant
