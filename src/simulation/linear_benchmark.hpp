// Solves linear systems of the constraint solver in isolation: iterations and time until a given residual.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "backend/pass_runner.hpp"
#include "body/cloth_model.hpp"
#include "pliant/scene.hpp"
#include "pliant/simulation.hpp"

namespace pliant {

/// The first linear system of a step of a scene's single cloth, which can be solved repeatedly. Ignores the
/// scene's `linear_tolerance` and iteration limits: conjugate gradients continue to the given residual.
class LinearBenchmark {
public:
    /// The step of `step_length` s begins at these positions and velocities. `backend` must not be automatic.
    LinearBenchmark(const Scene& scene, std::span<const Vec3> positions, std::span<const Vec3> velocities,
                    double step_length, Backend backend, const SimulationOptions& options);

    struct Solution {
        std::uint32_t iterations = 0;
        double residual = 1;  ///< |r| / |r0| at the end
        bool reached = false;
        double milliseconds = 0;  ///< includes the preparation of the preconditioner, excludes the assembly
                                  ///< of the system
    };
    /// Iterates until |r| / |r0| <= `goal`, tested after every `between` iterations, at most `most`
    /// iterations.
    Solution solve(double goal, std::uint32_t most, std::uint32_t between = 1);

private:
    std::vector<ClothModel> models_;
    std::unique_ptr<PassRunner> runner_;
    FrameInput input_;
    Program system_, start_;
};

}  // namespace pliant
