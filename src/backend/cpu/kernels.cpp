#include "backend/cpu/kernels.hpp"

#include <string>
#include <vector>

#include "pliant/error.hpp"

namespace pliant::cpu {

extern const Kernels kernels_baseline, kernels_avx2, kernels_avx512;
extern const Kernels kernels_avx2_fast, kernels_avx512_fast;
extern const Kernels kernels_lanes8, kernels_lanes16;

namespace {

/// The kernels with fast arithmetic for the same instruction set; null if there are none.
const Kernels* fast_kernels([[maybe_unused]] const Kernels& exact)
{
#if defined(__x86_64__)
    const auto with_solver = [](Kernels kernels, const Kernels& of) {
        kernels.solve = of.solve;
        kernels.solver_records = of.solver_records;
        return kernels;
    };
    static const Kernels avx2 = with_solver(kernels_avx2_fast, kernels_avx2);
    static const Kernels avx512 = with_solver(kernels_avx512_fast, kernels_avx512);
    if (&exact == &kernels_avx2) return &avx2;
    if (&exact == &kernels_avx512) return &avx512;
#endif
    return nullptr;
}

const Kernels& exact_kernels(const std::string& name)
{
    const auto available = available_kernels();
    if (name.empty()) return *available.back();
    std::string names;
    for (const Kernels* kernels : available) {
        if (kernels->name == name) return *kernels;
        names += (names.empty() ? "" : ", ") + std::string(kernels->name);
    }
    for (const Kernels* kernels : test_kernels())
        if (kernels->name == name) return *kernels;
    throw Error(ErrorKind::bad_usage,
                "the instruction set '" + name + "' is not available: this machine has " + names);
}

}  // namespace

std::span<const Kernels* const> available_kernels()
{
    static const std::vector<const Kernels*> available = [] {
        std::vector<const Kernels*> list = {&kernels_baseline};
#if defined(__x86_64__)
        __builtin_cpu_init();
        if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) list.push_back(&kernels_avx2);
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
            list.push_back(&kernels_avx512);
#endif
        return list;
    }();
    return available;
}

std::span<const Kernels* const> test_kernels()
{
#if PLIANT_EVERY_WIDTH
    static constexpr const Kernels* kernels[] = {&kernels_lanes8, &kernels_lanes16};
    return kernels;
#else
    return {};
#endif
}

const Kernels& choose_kernels(const std::string& name, bool fast_math)
{
    const Kernels& exact = exact_kernels(name);
    if (!fast_math) return exact;
    if (const Kernels* fast = fast_kernels(exact)) return *fast;
    throw Error(ErrorKind::bad_usage,
                "fast math is not available on the cpu backend with the instruction set " +
                    std::string(exact.name) + ": it needs avx2 or avx512; leave it out");
}

}  // namespace pliant::cpu
