#include "simulation/linear_benchmark.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "backend/vulkan/vulkan_runner.hpp"
#include "kernels/planes.hpp"
#include "solve/newton_multigrid.hpp"

namespace pliant {
namespace {

Scene without_tolerance(Scene scene)
{
    scene.newton_multigrid.linear_tolerance = 0;  // otherwise the kernels would end the iteration by their
                                                  // own rule
    return scene;
}

std::unique_ptr<PassRunner> make_runner(std::span<const ClothModel> models, Backend backend,
                                        const SimulationOptions& options)
{
    switch (backend) {
        case Backend::vulkan: return make_vulkan_runner(models, options);
        case Backend::reference: return make_reference_runner(models);
        default: return make_cpu_runner(models, options);
    }
}

}  // namespace

LinearBenchmark::LinearBenchmark(const Scene& scene, std::span<const Vec3> positions,
                                 std::span<const Vec3> velocities, double step_length, Backend backend,
                                 const SimulationOptions& options)
{
    models_.emplace_back(scene.cloth(0), without_tolerance(scene));
    ClothModel& model = models_.front();
    for (std::uint32_t vertex = 0; vertex < positions.size(); ++vertex) {  // the model has its rest lengths
                                                                           // already
        model.shape.positions[model.shape.node(vertex)] = positions[vertex];
        model.shape.velocities[model.shape.node(vertex)] = velocities[vertex];
    }
    runner_ = make_runner(models_, backend, options);
    input_.step_length = step_length;
    system_.id = 1;
    append_linear_system(models_.front(), 0, 0, system_.calls);
    start_.id = 2;
    append_linear_start(models_.front(), 0, 0, start_.calls);
}

LinearBenchmark::Solution LinearBenchmark::solve(double goal, std::uint32_t most, std::uint32_t between)
{
    Program iterations{2 + std::uint64_t{between}, {}, 0};  // one program for each `between`
    append_linear_iterations(models_.front(), 0, 0, between, iterations.calls);
    runner_->run(system_, input_);

    Solution solution;
    const auto start = std::chrono::steady_clock::now();
    runner_->run(start_, input_);
    while (!solution.reached && solution.iterations < most) {
        runner_->run(iterations, input_);
        const auto scalar = [&](int number) {
            return runner_->solver_scalar(0, static_cast<std::size_t>(number));
        };
        const auto made = static_cast<std::uint32_t>(scalar(scalar_iterations));
        const double first = scalar(scalar_first_residual2);
        solution.residual = first > 0 ? std::sqrt(scalar(scalar_residual2) / first) : 0;
        solution.reached = solution.residual <= goal;
        if (made == solution.iterations) break;  // no progress: limited by rounding
        solution.iterations = made;
    }
    solution.milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return solution;
}

}  // namespace pliant
