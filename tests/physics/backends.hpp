// Tests of physics that run on every backend.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "test_cloths.hpp"

namespace pliant::test {

inline constexpr Backend all_backends[] = {Backend::reference, Backend::cpu, Backend::vulkan};

class OnEveryBackend : public testing::TestWithParam<Backend> {
protected:
    SimulationOptions options() const { return on(GetParam()); }
    bool exact() const { return GetParam() == Backend::reference; }
};

inline std::string backend_name(const testing::TestParamInfo<Backend>& backend)
{
    return name_of(backend.param);
}

inline TimeOptions steps(double frame_rate, std::uint32_t substeps)
{
    return {.duration = 1, .frame_rate = frame_rate, .substeps = substeps};
}

}  // namespace pliant::test
