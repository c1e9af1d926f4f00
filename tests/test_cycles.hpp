// How many V-cycles the linear systems of the first frames take.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

#include "pliant/pliant.hpp"
#include "test_cloths.hpp"

namespace pliant::test {

/// Takes three frames of 1/60 s, of up to three Newton iterations each, solved to 1e-3 of the first residual;
/// each iteration must need a cycle, and at most so many.
inline void expect_few_cycles(Scene scene, const std::array<std::uint32_t, 3>& most, const std::string& who)
{
    auto& newton = scene.newton_multigrid;
    newton.resists = Resists::both;
    newton.newton_iterations = 1;
    newton.step_cuts = 0;
    newton.linear_iterations = 100;
    newton.linear_tolerance = 1e-3;
    Simulation simulation(scene, on(Backend::cpu));
    for (std::size_t k = 0; k < most.size(); ++k) {
        simulation.advance(1.0 / 60);
        const SolverReport& solver = simulation.report().solver;
        EXPECT_GE(solver.iterations_last, solver.newton_last) << who << ", frame " << k;
        EXPECT_GE(solver.newton_last, 1u) << who << ", frame " << k;
        EXPECT_LE(solver.iterations_last, most[k] * solver.newton_last) << who << ", frame " << k;
    }
}

}  // namespace pliant::test
