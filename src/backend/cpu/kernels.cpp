#include "backend/cpu/kernels.hpp"

#include <string>
#include <vector>

#include "pliant/error.hpp"

namespace pliant::cpu {

extern const Kernels kernels_baseline, kernels_avx2, kernels_avx512;

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

const Kernels& choose_kernels(const std::string& name)
{
    const auto available = available_kernels();
    if (name.empty()) return *available.back();
    std::string names;
    for (const Kernels* kernels : available) {
        if (kernels->name == name) return *kernels;
        names += (names.empty() ? "" : ", ") + std::string(kernels->name);
    }
    throw Error(ErrorKind::bad_usage,
                "the instruction set '" + name + "' is not available: this machine has " + names);
}

}  // namespace pliant::cpu
