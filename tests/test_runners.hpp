// Backends below the public face, for tests of passes.
#pragma once

#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "backend/cpu/kernels.hpp"
#include "backend/pass_runner.hpp"
#include "backend/vulkan/device.hpp"
#include "backend/vulkan/vulkan_runner.hpp"
#include "test_cloths.hpp"

namespace pliant::test {

/// Everywhere but in an emulator of another machine, and where nobody wants it (scripts/mutants.py).
#if defined(PLIANT_NO_VULKAN_DRIVER)
inline constexpr bool has_vulkan = false;
#else
inline const bool has_vulkan = std::getenv("PLIANT_NO_VULKAN") == nullptr;
#endif

inline std::vector<Backend> backends()
{
    std::vector<Backend> all = {Backend::reference, Backend::cpu};
    if (has_vulkan) all.push_back(Backend::vulkan);
    return all;
}

inline std::unique_ptr<PassRunner> make_runner(Backend backend, const ClothModel& model)
{
    if (backend == Backend::vulkan) return make_vulkan_runner({&model, 1}, on(backend));
    return backend == Backend::reference ? make_reference_runner({&model, 1})
                                         : make_cpu_runner({&model, 1}, {});
}

/// A way to run the CPU backend; all of them must give the same bits.
struct CpuWay {
    const char* instruction_set;
    unsigned threads;
    SimulationOptions options() const
    {
        return {.backend = Backend::cpu, .threads = threads, .instruction_set = instruction_set};
    }
};
inline std::ostream& operator<<(std::ostream& out, const CpuWay& way)
{
    return out << way.instruction_set << ", " << way.threads << " threads";
}
inline std::vector<const char*> instruction_sets()
{
    std::vector<const char*> names;
    for (const auto sets : {cpu::available_kernels(), cpu::test_kernels()})
        for (const cpu::Kernels* kernels : sets) names.push_back(kernels->name);
    return names;
}
/// Every width on every machine, each on numbers of threads that part nothing evenly.
inline std::vector<CpuWay> every_cpu_way()
{
    std::vector<CpuWay> ways;
    for (const char* name : instruction_sets())
        for (const unsigned threads : {1U, 2U, 3U, 7U}) ways.push_back({name, threads});
    return ways;
}
/// As in `./dev test --all`.
inline bool wants_every_way() { return std::getenv("PLIANT_EVERY_WAY") != nullptr; }
/// Every width and every number of threads, but only the machine's widest set with each of them: packs for
/// tests alone are slow. With PLIANT_EVERY_WAY=1 each with each.
inline std::vector<CpuWay> cpu_ways()
{
    if (wants_every_way()) return every_cpu_way();
    const std::string widest = cpu::available_kernels().back()->name;
    std::vector<CpuWay> ways;
    for (const CpuWay& way : every_cpu_way())
        if (way.threads == 3 || way.instruction_set == widest) ways.push_back(way);
    return ways;
}

/// A cloth whose nodes are shaken, so that springs are stretched and moving.
inline ClothModel shaken_model(const Scene& scene)
{
    ClothModel model(scene.cloth(0), scene);
    std::mt19937 engine(11);
    std::uniform_real_distribution<float> unit(-1, 1);
    const double length =
        model.shape.sheet ? model.shape.sheet->rest_lengths[0] : model.springs.list.front().rest_length;
    const float shake = 0.1f * static_cast<float>(length);
    for (std::size_t i = 0; i < model.shape.positions.size(); ++i) {
        Vec3& x = model.shape.positions[i];
        x = {x.x + shake * unit(engine), x.y + shake * unit(engine), x.z + shake * unit(engine)};
        if (model.masses.inverse(i) > 0)
            model.shape.velocities[i] = {unit(engine), unit(engine), unit(engine)};
    }
    return model;
}

}  // namespace pliant::test
