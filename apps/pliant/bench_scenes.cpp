#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "bench_command.hpp"

namespace pliant::tool {
namespace {

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

/// A patch of 1 m x 1 m whose vertices are jittered, whose diagonals go either way, and whose numbers are
/// drawn, so that nothing in its order helps. The first two vertices are the corners that hold it.
SurfaceMesh irregular_mesh(std::uint32_t n)
{
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> jitter(-0.25f, 0.25f);
    std::vector<std::uint32_t> number(std::size_t{n} * n);
    for (std::uint32_t i = 0; i < n * n; ++i) number[i] = i;
    for (std::uint32_t i = n * n - 1; i > 0; --i)
        std::swap(number[i], number[engine() % (std::uint64_t{i} + 1)]);
    std::swap(number[0], *std::find(number.begin(), number.end(), 0u));
    std::swap(number[n - 1], *std::find(number.begin(), number.end(), 1u));

    SurfaceMesh mesh;
    mesh.vertices.resize(number.size());
    const float h = 1.0f / static_cast<float>(n - 1);
    for (std::uint32_t r = 0; r < n; ++r)
        for (std::uint32_t c = 0; c < n; ++c)
            mesh.vertices[number[r * n + c]] = {h * (static_cast<float>(c) + jitter(engine)), 0,
                                                h * (static_cast<float>(r) + jitter(engine))};
    for (std::uint32_t r = 0; r + 1 < n; ++r)
        for (std::uint32_t c = 0; c + 1 < n; ++c) {
            const std::uint32_t a = number[r * n + c], b = number[r * n + c + 1];
            const std::uint32_t d = number[(r + 1) * n + c], e = number[(r + 1) * n + c + 1];
            if (engine() % 2) {
                mesh.triangles.push_back({a, d, b});
                mesh.triangles.push_back({b, d, e});
            } else {
                mesh.triangles.push_back({a, d, e});
                mesh.triangles.push_back({a, e, b});
            }
        }
    return mesh;
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
    const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(nodes)));
    Cloth cloth = Cloth::mesh(irregular_mesh(n), {.density = 0.3});
    cloth.pin(0u).pin(1u);
    return hung(std::move(cloth), compliance);
}

Scene hanging_file(const std::string& mesh_file, double compliance)
{
    Cloth cloth = Cloth::mesh(read_mesh(mesh_file), {.density = 0.3});
    cloth.pin(0u).pin(1u);
    return hung(std::move(cloth), compliance);
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
