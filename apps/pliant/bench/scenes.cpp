#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "bench/bench_command.hpp"
#include "pliant/mesh_generators.hpp"

namespace pliant::tool {
namespace {

constexpr double garment_compliance = 1e-6;  // m/N

void make_constraint(SpringParameters& springs, double compliance)
{
    springs = {};
    springs.role = SpringRole::constraint;
    springs.compliance = compliance;
}

Scene hung(Cloth cloth, double compliance)
{
    Scene scene;
    scene.method = Method::constraint;
    cloth.damping = 0.1;
    make_constraint(cloth.springs.structural, compliance);
    make_constraint(cloth.springs.shear, compliance);
    cloth.springs.bend = {1, 0};
    scene.add(std::move(cloth));
    return scene;
}

/// The vertex nearest to a position, m.
std::uint32_t vertex_at(const SurfaceMesh& mesh, Vec3d place)
{
    const auto distance2 = [&](Vec3 x) {
        const Vec3d d = to_double(x) - place;
        return dot(d, d);
    };
    const auto nearest = std::min_element(mesh.vertices.begin(), mesh.vertices.end(),
                                          [&](Vec3 a, Vec3 b) { return distance2(a) < distance2(b); });
    return static_cast<std::uint32_t>(nearest - mesh.vertices.begin());
}

/// The number of parts for about `nodes` nodes, if a number of n parts gives per_part2 n^2 nodes.
std::uint32_t parts_of(std::uint32_t nodes, double per_part2)
{
    return static_cast<std::uint32_t>(std::max(1l, std::lround(std::sqrt(nodes / per_part2))));
}

/// Pinned at the vertices nearest to two positions of the upright mesh, then laid horizontally, so that it
/// falls like the others.
Scene hung_at(SurfaceMesh mesh, Vec3d left, Vec3d right)
{
    const std::uint32_t first = vertex_at(mesh, left), second = vertex_at(mesh, right);
    Cloth cloth = Cloth::mesh(std::move(mesh), {.density = 0.3});
    cloth.rotation = {-90, 0, 0};
    cloth.pin(first).pin(second);
    return hung(std::move(cloth), garment_compliance);
}

}  // namespace

Scene hanging_sheet(std::uint32_t n, double compliance, double density)
{
    Cloth cloth = Cloth::sheet({.rows = n, .columns = n, .width = 1, .height = 1, .density = density});
    cloth.pin(Corner::top_left).pin(Corner::top_right);
    return hung(std::move(cloth), compliance);
}

Scene hanging_mesh(std::uint32_t nodes, double compliance)
{
    const std::uint32_t n = parts_of(nodes, 1);
    Cloth cloth = Cloth::mesh(irregular_sheet_mesh({.rows = n, .columns = n}), {.density = 0.3});
    cloth.pin(0u).pin(n - 1);
    return hung(std::move(cloth), compliance);
}

Scene hanging_file(const std::string& mesh_file, double compliance)
{
    Cloth cloth = Cloth::mesh(read_mesh(mesh_file), {.density = 0.3});
    cloth.pin(0u).pin(1u);
    return hung(std::move(cloth), compliance);
}

Scene hanging_disc(std::uint32_t nodes)
{
    const std::uint32_t rings = parts_of(nodes, 3), hem = 1 + 3 * rings * (rings - 1);
    Cloth cloth = Cloth::disc({.radius = 0.5, .rings = rings, .density = 0.3});
    cloth.pin(hem + 3 * rings / 4).pin(hem + 9 * rings / 4);  // an eighth and three eighths around
    return hung(std::move(cloth), garment_compliance);
}

Scene hanging_tube(std::uint32_t nodes)
{
    TubeOptions tube;
    const double per_row = double(tube.segments) / tube.rows;  // for equilateral triangles
    tube.rows = std::max(2u, parts_of(nodes, per_row));
    tube.segments = std::max(3u, nodes / tube.rows);
    return hung_at(tube_mesh(tube), {-tube.radius, tube.length / 2, 0}, {tube.radius, tube.length / 2, 0});
}

Scene hanging_shirt(std::uint32_t nodes)
{
    const ShirtOptions shirt{.squares = parts_of(nodes, 320)};
    const double shoulder = shirt.width / 4, top = 0.65 * shirt.width;
    return hung_at(shirt_mesh(shirt), {-shoulder, top, 0}, {shoulder, top, 0});
}

void bend_by_constraints(Scene& scene, double compliance)
{
    make_constraint(scene.cloth_handle(0)->springs.bend, compliance);
}

double milliseconds_to_advance(Simulation& simulation, double duration)
{
    const auto start = std::chrono::steady_clock::now();
    simulation.advance(duration);
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace pliant::tool
