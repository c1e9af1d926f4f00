// require_closed: the requirements of a body with volume on its surface.
#include <cmath>
#include <string>

#include "files/formatted.hpp"
#include "mesh/mesh_description.hpp"
#include "mesh/mesh_topology.hpp"
#include "pliant/error.hpp"
#include "pliant/mesh.hpp"

namespace pliant {
namespace {

bool is_good(const MeshReport& report)
{
    return report.closed && report.oriented && report.isolated_vertices == 0 && report.edge_min > 0 &&
           report.inward_components == 0 && report.volume > flat_volume(report.area);
}

/// A round tolerance that welds almost matching seams but keeps the ends of every edge apart; 0: there is
/// none.
double weld_suggestion(const MeshReport& report)
{
    const double most = report.edge_min / 10;
    return most > 0 && most < 1e3 ? std::pow(10, std::floor(std::log10(most))) : 0;
}

/// The mildest repair that fixes the mesh, or a note that none does.
std::string remedy(const SurfaceMesh& mesh, const MeshReport& report, const std::string& name)
{
    const double tolerance = weld_suggestion(report);
    for (const RepairOptions options : {RepairOptions{0, false}, {tolerance, false}, {0, true}}) {
        SurfaceMesh mended = mesh;
        repair_mesh(mended, options);
        if (!is_good(inspect_mesh(mended))) continue;
        const std::string file = mesh.file.empty() ? name : mesh.file.string();
        return "repair it with 'pliant check " + file + " --repair" +
               (options.weld_tolerance > 0 ? " --weld " + number_text(tolerance) : "") +
               (options.fill_holes ? " --fill-holes" : "") + " --out FIXED.ply'";
    }
    return "'pliant check --repair' cannot fix this; repair it in a modelling program";
}

std::string at_vertex(const SurfaceMesh& mesh, std::uint32_t vertex)
{
    return "vertex " + std::to_string(vertex) + " at " + rounded(to_double(mesh.vertices[vertex])) + " m";
}

/// What is wrong, and where.
std::string fault(const SurfaceMesh& mesh, const MeshReport& report)
{
    if (report.triangles == 0) return "it has no triangles";
    if (report.boundary_loops > 0) {
        const BoundaryLoop& loop = *std::ranges::max_element(report.loops, {}, &BoundaryLoop::length);
        return "it is not closed: " + counted(report.boundary_edges, "edge", "edges") + " in " +
               counted(report.boundary_loops, "boundary loop", "boundary loops") + ", the longest of " +
               counted(loop.edges, "edge", "edges") + " and " + rounded(loop.length) + " m at vertex " +
               std::to_string(loop.vertex) + " at " + rounded(loop.position) + " m";
    }
    if (report.non_manifold_edges > 0)
        return counted(report.non_manifold_edges, "edge has", "edges have") +
               " three or more triangles, first that between " +
               at_vertex(mesh, report.first_non_manifold_edge[0]) + " and vertex " +
               std::to_string(report.first_non_manifold_edge[1]);
    if (report.non_manifold_vertices > 0)
        return "parts of it touch in " + counted(report.non_manifold_vertices, "vertex", "vertices") +
               ", first " + at_vertex(mesh, report.first_non_manifold_vertex);
    if (report.isolated_vertices > 0)
        return counted(report.isolated_vertices, "vertex belongs", "vertices belong") + " to no triangle";
    if (report.edge_min == 0) return "it has an edge without length";
    if (!report.oriented)
        return "its triangles do not agree on the side that is outside, first at an edge of " +
               at_vertex(mesh, report.first_disagreement);
    if (report.inward_components > 0)
        return counted(report.inward_components, "component is", "components are") +
               " inside out (volume of the mesh " + rounded(report.volume) + " m^3)";
    return "it encloses no volume (" + rounded(report.volume) + " m^3 within " + rounded(report.area) +
           " m^2)";
}

}  // namespace

void require_closed(const SurfaceMesh& mesh, const std::string& name)
{
    const MeshReport report = inspect_mesh(mesh);
    if (is_good(report)) return;
    throw Error(ErrorKind::bad_input,
                "'" + name + "' cannot be a body with volume: " + fault(mesh, report) +
                    (report.triangles == 0 ? "; use a closed mesh" : "; " + remedy(mesh, report, name)));
}

}  // namespace pliant
