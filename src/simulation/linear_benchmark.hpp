// The linear systems of the constraint solver by themselves: how many iterations one takes to a residual, and
// how long.
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

/// The first linear system of a step of a scene's one cloth, solved as often as asked. The scene's
/// `linear_tolerance` and limits of iterations are not used: conjugate gradients go on to the residual asked
/// for.
class LinearBenchmark {
public:
    /// A step of `step_length` s begins at these positions and velocities. `backend` must not be automatic.
    LinearBenchmark(const Scene& scene, std::span<const Vec3> positions, std::span<const Vec3> velocities,
                    double step_length, Backend backend, const SimulationOptions& options);

    struct Solution {
        std::uint32_t iterations = 0;
        double residual = 1;  ///< |r| / |r0| at the end
        bool reached = false;
        double milliseconds = 0;  ///< with what prepares the preconditioner, without the system itself
    };
    /// Iterates until |r| / |r0| <= `goal`, which is looked at after every `between` iterations, or `most`
    /// are made.
    Solution solve(double goal, std::uint32_t most, std::uint32_t between = 1);

private:
    std::vector<ClothModel> models_;
    std::unique_ptr<PassRunner> runner_;
    FrameInput input_;
    Program system_, start_;
};

}  // namespace pliant
