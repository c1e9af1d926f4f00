// repair_mesh: the order of its steps, and the removal of triangles.
#include <set>
#include <string>
#include <utility>

#include "files/formatted.hpp"
#include "mesh/hole_filling.hpp"
#include "mesh/mesh_orientation.hpp"
#include "mesh/mesh_topology.hpp"
#include "mesh/mesh_welding.hpp"
#include "pliant/error.hpp"

namespace pliant {
namespace {

void drop_repeated_vertices(SurfaceMesh& mesh, RepairReport& report)
{
    report.dropped_triangles += std::erase_if(mesh.triangles, has_repeated_vertex);
}

/// Keeps the first of the triangles with the same three vertices.
void drop_duplicates(SurfaceMesh& mesh, RepairReport& report)
{
    std::vector<std::pair<Triangle, std::size_t>> sorted;
    sorted.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        sorted.emplace_back(mesh.triangles[t], t);
        std::ranges::sort(sorted.back().first);
    }
    std::ranges::sort(sorted);
    std::vector<bool> again(mesh.triangles.size());
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i].first == sorted[i - 1].first) again[sorted[i].second] = true;
    std::size_t at = 0;
    report.duplicate_triangles +=
        std::erase_if(mesh.triangles, [&](const Triangle&) { return bool(again[at++]); });
}

/// The index of a triangle's longest side.
std::size_t longest_side(const SurfaceMesh& mesh, const Triangle& t)
{
    const auto squared = [&](std::size_t side) {
        const Vec3d way = to_double(mesh.vertices[t[(side + 1) % 3]]) - to_double(mesh.vertices[t[side]]);
        return dot(way, way);
    };
    std::size_t best = 0;
    for (const std::size_t side : {1u, 2u})
        if (squared(side) > squared(best)) best = side;
    return best;
}

/// A degenerate triangle with three different vertices has one vertex on its longest edge. Dropping it would
/// open the surface there; flipping that edge removes it instead. At the boundary it is dropped. One pass;
/// returns whether anything changed.
bool end_flat_triangles(SurfaceMesh& mesh, RepairReport& report)
{
    const std::vector<EdgeUse> uses = edge_uses(mesh);
    const auto joined = [&](std::uint32_t a, std::uint32_t b) {
        const EdgeUse key{std::min(a, b), std::max(a, b), 0};
        const auto found =
            std::ranges::lower_bound(uses, std::pair(key.low, key.high), {},
                                     [](const EdgeUse& use) { return std::pair(use.low, use.high); });
        return found != uses.end() && found->same_edge(key);
    };
    std::vector<bool> changed(mesh.triangles.size()), drop(mesh.triangles.size());
    std::set<std::pair<std::uint32_t, std::uint32_t>> made;  // new edges of this pass, which are not in
                                                             // `uses`
    const auto drops_before = report.dropped_triangles, flips_before = report.flipped_edges;
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
        if (edge.size() > 2) return;
        for (std::size_t k = 0; k < edge.size(); ++k) {
            const std::size_t flat = edge[k].triangle();
            if (changed[flat] || !is_flat(mesh, mesh.triangles[flat]) ||
                longest_side(mesh, mesh.triangles[flat]) != edge[k].corner % 3)
                continue;
            if (edge.size() == 1) {
                drop[flat] = changed[flat] = true;
                ++report.dropped_triangles;
                continue;
            }
            const EdgeUse& opposite = edge[1 - k];
            const std::size_t other = opposite.triangle();
            if (changed[other] || edge[0].goes_up(mesh) == edge[1].goes_up(mesh)) continue;
            const auto vertex = [&](const EdgeUse& use, std::size_t step) {
                return mesh.triangles[use.triangle()][(use.corner + step) % 3];  // 3 * triangle vanishes
                                                                                 // modulo 3
            };
            const std::uint32_t a = vertex(edge[k], 0), b = vertex(edge[k], 1), tip = vertex(edge[k], 2),
                                far_tip = vertex(opposite, 2);
            const Triangle first = {tip, a, far_tip}, second = {far_tip, b, tip};
            if (tip == far_tip || joined(tip, far_tip) || is_flat(mesh, first) || is_flat(mesh, second) ||
                !made.insert(std::minmax(tip, far_tip)).second)
                continue;
            mesh.triangles[flat] = first;
            mesh.triangles[other] = second;
            changed[flat] = changed[other] = true;
            ++report.flipped_edges;
        }
    });
    std::size_t at = 0;
    std::erase_if(mesh.triangles, [&](const Triangle&) { return bool(drop[at++]); });
    return report.dropped_triangles != drops_before || report.flipped_edges != flips_before;
}

bool is_closed(const SurfaceMesh& mesh) { return inspect_mesh(mesh).closed; }

/// Welds and drops; does nothing if that would open a closed mesh.
void clean(SurfaceMesh& mesh, double weld_tolerance, RepairReport& report)
{
    SurfaceMesh cleaned = mesh;
    RepairReport done;
    done.welded_vertices = weld_vertices(cleaned, weld_tolerance);
    drop_repeated_vertices(cleaned, done);
    drop_duplicates(cleaned, done);
    constexpr int most_passes = 10;  // each removes the flat triangles that touch no other
    for (int pass = 0; pass < most_passes && end_flat_triangles(cleaned, done); ++pass) {
    }
    if (describe(done).empty() || cleaned.triangles.empty() || (is_closed(mesh) && !is_closed(cleaned)))
        return;
    mesh = std::move(cleaned);
    report = done;
}

}  // namespace

RepairReport repair_mesh(SurfaceMesh& mesh, const RepairOptions& options)
{
    require_valid(mesh);
    constexpr double largest_tolerance = 1e4;
    if (!(options.weld_tolerance >= 0 && options.weld_tolerance <= largest_tolerance))
        throw Error(ErrorKind::bad_input, "the tolerance of welding is " +
                                              number_text(options.weld_tolerance) +
                                              " m, but must be between 0 and 10000 m");
    RepairReport report;
    if (mesh.triangles.empty()) return report;
    clean(mesh, options.weld_tolerance, report);
    report.isolated_vertices = drop_isolated_vertices(mesh);
    const std::vector<Triangle> before = mesh.triangles;
    turn_triangles(mesh, plan_orientation(mesh, edge_uses(mesh)).turn);
    if (options.fill_holes) {
        const HoleFilling filling = fill_holes(mesh);
        report.filled_holes = filling.holes;
        report.added_triangles = filling.triangles;
        report.added_vertices = filling.vertices;
        // While it was open, its outside was undefined.
        if (filling.holes > 0) turn_triangles(mesh, plan_orientation(mesh, edge_uses(mesh)).turn);
    }
    for (std::size_t t = 0; t < before.size(); ++t) report.turned_triangles += mesh.triangles[t] != before[t];
    report.open_loops = boundary_loops(mesh, edge_uses(mesh)).size();
    return report;
}

}  // namespace pliant
