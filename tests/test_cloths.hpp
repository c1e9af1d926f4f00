// Cloths that several tests share.
#pragma once

#include <cmath>
#include <random>

#include "pliant/pliant.hpp"

namespace pliant::test {

inline Cloth flat_sheet(std::uint32_t rows, std::uint32_t columns, double width = 1, double height = 1)
{
    Cloth cloth =
        Cloth::sheet({.rows = rows, .columns = columns, .width = width, .height = height, .density = 0.3});
    cloth.springs = {{1000, 0.02}, {500, 0.03}, {10, 0.004}};
    return cloth;
}

/// Implicit steps are solved as far as their numbers go.
inline void converge(Scene& scene)
{
    scene.newton_multigrid.newton_iterations = 60;
    scene.newton_multigrid.newton_tolerance = 1e-7;
    scene.newton_multigrid.linear_iterations = 60;
    scene.newton_multigrid.linear_tolerance = 1e-4;
}

/// Two triangles for each cell of a patch: name(row, column) is the vertex there, and rises(row, column)
/// whether the diagonal leads from the next column to the next row.
template <class Name, class Choice>
void add_cells(SurfaceMesh& mesh, std::uint32_t rows, std::uint32_t columns, const Name& name,
               const Choice& rises)
{
    for (std::uint32_t r = 0; r + 1 < rows; ++r)
        for (std::uint32_t c = 0; c + 1 < columns; ++c) {
            const std::uint32_t a = name(r, c), b = name(r, c + 1), d = name(r + 1, c),
                                e = name(r + 1, c + 1);
            if (rises(r, c)) {
                mesh.triangles.push_back({a, d, b});
                mesh.triangles.push_back({b, d, e});
            } else {
                mesh.triangles.push_back({a, d, e});
                mesh.triangles.push_back({a, e, b});
            }
        }
}

/// A triangulated patch with jittered vertices and diagonals at random; the vertices are numbered at random
/// too, so that nothing in its order helps.
inline SurfaceMesh irregular_mesh(std::uint32_t rows, std::uint32_t columns, unsigned seed = 7)
{
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> jitter(-0.25f, 0.25f);
    const std::uint32_t count = rows * columns;
    std::vector<std::uint32_t> name(count);
    for (std::uint32_t i = 0; i < count; ++i) name[i] = i;
    for (std::uint32_t i = count - 1; i > 0; --i) std::swap(name[i], name[engine() % (i + 1)]);

    SurfaceMesh mesh;
    mesh.vertices.resize(count);
    const float h = 1.0f / static_cast<float>(std::max(rows, columns));
    for (std::uint32_t r = 0; r < rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c)
            mesh.vertices[name[r * columns + c]] = {h * (static_cast<float>(c) + jitter(engine)),
                                                    h * 0.2f * jitter(engine),
                                                    h * (static_cast<float>(r) + jitter(engine))};
    add_cells(
        mesh, rows, columns, [&](std::uint32_t r, std::uint32_t c) { return name[r * columns + c]; },
        [&](std::uint32_t, std::uint32_t) { return engine() % 2 == 1; });
    return mesh;
}

/// One for all tests of a process, with the validation layer, so that pipelines are compiled once; none where
/// there is no device. In validation_listener.cpp, which closes it behind the last test.
std::shared_ptr<vulkan::Device> shared_device();

inline SimulationOptions on(Backend backend)
{
    SimulationOptions options;
    options.backend = backend;
    if (backend == Backend::vulkan) options.shared_device = shared_device();
    return options;
}

}  // namespace pliant::test
