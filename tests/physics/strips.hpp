// Strips of cloth that several tests of physics hang, clamp and pull.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "test_cloths.hpp"

namespace pliant::test {

/// Steps to rest: implicit Euler with long steps, each solved as far as its numbers go. A swing of angular
/// frequency w loses all but 1 / sqrt(1 + (w dt)^2) of its amplitude in a step.
inline void seek_rest(Scene& scene, double step = 1)
{
    if (scene.method == Method::mass_spring) scene.integrator = Integrator::implicit_euler;
    scene.time = {.duration = 100, .frame_rate = 1 / step, .substeps = 1};
    scene.newton_multigrid.newton_iterations = 100;
    scene.newton_multigrid.newton_tolerance = 1e-9;
    scene.newton_multigrid.linear_iterations = 200;
    scene.newton_multigrid.linear_tolerance = 1e-4;
}

inline std::vector<Vec3d> positions_of(Simulation& simulation)
{
    std::vector<Vec3d> all;
    for (const Vec3& x : simulation.positions()) all.push_back(to_double(x));
    return all;
}

/// A rectangle in the x-z plane, around the origin, as triangles: a sheet's nodes, with all diagonals alike.
inline SurfaceMesh grid_mesh(std::uint32_t rows, std::uint32_t columns, double width, double height)
{
    SurfaceMesh mesh;
    for (std::uint32_t r = 0; r < rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c)
            mesh.vertices.push_back(
                to_float({width * (c / (columns - 1.0) - 0.5), 0, height * (r / (rows - 1.0) - 0.5)}));
    for (std::uint32_t r = 0; r + 1 < rows; ++r)
        for (std::uint32_t c = 0; c + 1 < columns; ++c) {
            const std::uint32_t a = r * columns + c, b = a + columns;
            mesh.triangles.push_back({a, b, a + 1});
            mesh.triangles.push_back({a + 1, b, b + 1});
        }
    return mesh;
}

/// A strip that hangs by its upper edge, row 0, undamped, of the continuum's constants.
inline Cloth hanging_strip(std::uint32_t rows, std::uint32_t columns, double width, double height,
                           double density, double structural, double shear)
{
    Cloth cloth = Cloth::sheet({.rows = rows,
                                .columns = columns,
                                .width = width,
                                .height = height,
                                .border = SheetBorder::half,
                                .density = density});
    cloth.rotation = {90, 0, 0};
    cloth.springs = {{structural, 0}, {shear, 0}, {0, 0}};
    cloth.damping = 0;
    cloth.pin(Edge::top);
    return cloth;
}

/// Where the nodes are after so many steps.
inline std::vector<Vec3d> at_rest(const Scene& scene, int steps, Backend backend = Backend::reference)
{
    Simulation simulation(scene, on(backend));
    for (int step = 0; step < steps; ++step) simulation.advance(1 / scene.time.frame_rate);
    EXPECT_TRUE(simulation.report().finite);
    return positions_of(simulation);
}

}  // namespace pliant::test
