// Backends below the public face, for tests of passes.
#pragma once

#include "backend/pass_runner.hpp"
#include "backend/vulkan/vulkan_runner.hpp"
#include "test_cloths.hpp"

namespace pliant::test {

inline std::unique_ptr<PassRunner> make_runner(Backend backend, const ClothModel& model)
{
    if (backend == Backend::vulkan) return make_vulkan_runner({&model, 1}, on(backend));
    return backend == Backend::reference ? make_reference_runner({&model, 1})
                                         : make_cpu_runner({&model, 1}, {});
}

}  // namespace pliant::test
