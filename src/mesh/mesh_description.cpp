// describe: reports on meshes as text.
#include "mesh/mesh_description.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "pliant/mesh.hpp"

namespace pliant {

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

namespace {

std::string orientation_of(const MeshReport& report)
{
    if (!report.orientable) return "not orientable";
    if (!report.oriented) return "not consistently oriented";
    if (report.inward_components > 0)
        return "consistently oriented, " + counted(report.inward_components, "component", "components") +
               " inside out";
    return report.closed && report.volume > 0 ? "consistently oriented outward" : "consistently oriented";
}

std::string surface_of(const MeshReport& report)
{
    std::string text = std::string("surface: ") + (report.closed ? "closed" : "not closed") + ", " +
                       orientation_of(report) + ", Euler characteristic " +
                       std::to_string(report.euler_characteristic);
    if (report.closed && report.orientable) text += ", genus " + std::to_string(report.genus);
    text += "\narea: " + rounded(report.area) + " m^2\n";
    if (report.closed && report.oriented) {
        text += "volume: " + rounded(report.volume) + " m^3";
        text += report.volume < 0 ? " (negative: the surface is inside out)\n" : "\n";
    }
    return text + "edge length: " + rounded(report.edge_min) + " to " + rounded(report.edge_max) +
           " m, mean " + rounded(report.edge_mean) + " m\n";
}

/// The longest first.
std::string loops_of(const MeshReport& report)
{
    constexpr std::size_t most = 8;
    std::vector<BoundaryLoop> loops = report.loops;
    std::ranges::stable_sort(loops, std::greater<>{}, &BoundaryLoop::length);
    std::string text;
    for (std::size_t i = 0; i < std::min(most, loops.size()); ++i)
        text += "  of " + counted(loops[i].edges, "edge", "edges") + ", " + rounded(loops[i].length) +
                " m long, at vertex " + std::to_string(loops[i].vertex) + " " + rounded(loops[i].position) +
                " m\n";
    if (loops.size() > most) text += "  and " + std::to_string(loops.size() - most) + " shorter\n";
    return text;
}

}  // namespace

std::string describe(const MeshReport& report)
{
    std::string text = counted(report.vertices, "vertex", "vertices") + ", " +
                       counted(report.edges, "edge", "edges") + ", " +
                       counted(report.triangles, "triangle", "triangles") + " in " +
                       counted(report.components, "component", "components") + "\n";
    if (report.triangles > 0) text += surface_of(report);
    text += "bounds: " + rounded(report.bounds_min) + " to " + rounded(report.bounds_max) + " m\n";

    const auto remark = [&](std::size_t count, const char* one, const char* many,
                            const std::string& where = "") {
        if (count > 0) text += counted(count, one, many) + where + "\n";
    };
    remark(report.boundary_edges, "boundary edge", "boundary edges");
    remark(report.boundary_loops, "boundary loop", "boundary loops");
    text += loops_of(report);
    remark(report.non_manifold_edges, "non-manifold edge (three or more triangles)",
           "non-manifold edges (three or more triangles)",
           ", first between the vertices " + std::to_string(report.first_non_manifold_edge[0]) + " and " +
               std::to_string(report.first_non_manifold_edge[1]));
    remark(report.non_manifold_vertices, "non-manifold vertex (more than one fan)",
           "non-manifold vertices (more than one fan)",
           ", first vertex " + std::to_string(report.first_non_manifold_vertex));
    remark(report.degenerate_triangles, "degenerate triangle (a vertex twice, or no area)",
           "degenerate triangles (a vertex twice, or no area)");
    remark(report.duplicate_triangles, "duplicate triangle", "duplicate triangles");
    remark(report.coincident_vertices, "vertex at the position of another",
           "vertices at the position of another");
    remark(report.isolated_vertices, "vertex used by no triangle", "vertices used by no triangle");
    return text;
}

std::string describe(const RepairReport& report)
{
    std::string text;
    const auto line = [&](const char* what, std::size_t count) {
        if (count > 0) text += "  " + std::string(what) + ": " + std::to_string(count) + "\n";
    };
    line("vertices welded to others", report.welded_vertices);
    line("degenerate triangles dropped", report.dropped_triangles);
    line("edges of triangles without area turned", report.flipped_edges);
    line("duplicate triangles dropped", report.duplicate_triangles);
    line("unused vertices dropped", report.isolated_vertices);
    line("triangles turned round", report.turned_triangles);
    line("holes filled", report.filled_holes);
    line("triangles added", report.added_triangles);
    line("vertices added", report.added_vertices);
    return text;
}

}  // namespace pliant
