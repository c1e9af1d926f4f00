#include "bench/harness.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "pliant/extremes.hpp"

namespace pliant::tool {

void take_turns(std::span<Contestant* const> contestants, int repeats)
{
    for (int turn = -1; turn < repeats; ++turn)
        for (Contestant* contestant : contestants) {
            const double sample = contestant->run();
            if (turn >= 0) contestant->samples.push_back(sample);
        }
}

double ratio_of(const Contestant& a, const Contestant& b)
{
    std::vector<double> ratios;
    for (std::size_t k = 0; k < std::min(a.samples.size(), b.samples.size()); ++k)
        ratios.push_back(a.samples[k] / b.samples[k]);
    return median_of(std::move(ratios));
}

SteppedSimulation::SteppedSimulation(const Scene& scene, const SimulationOptions& options)
    : duration_(1 / scene.time.frame_rate), substeps_(scene.time.substeps), simulation_(scene, options)
{
}

double SteppedSimulation::all_measures() const
{
    double sum = 0;
    for (const PassTime& pass : simulation_.pass_times())
        if (pass.name.find("measure") != std::string::npos || pass.name == "volume_total")
            sum += pass.milliseconds;
    return sum;
}

double SteppedSimulation::milliseconds_of_measures() const
{
    return all_measures() / static_cast<double>(simulation_.report().frames + 1);  // including those of the
                                                                                   // start
}

double SteppedSimulation::milliseconds_per_step()
{
    const double measures_before = all_measures();
    const auto start = std::chrono::steady_clock::now();
    simulation_.advance(duration_);
    const double wall =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    stretch_ = larger(stretch_, simulation_.report().measures.max_stretch);
    return (wall - (all_measures() - measures_before)) / substeps_;
}

}  // namespace pliant::tool
