// shaders/layout.glsl as C++: the memory layout of a cloth that shaders and the host share.
#pragma once

#include <cstddef>
#include <cstdint>

#include "backend/vulkan/float4.hpp"
#include "body/hierarchy.hpp"

namespace pliant::vulkan {

using vec4 = Float4;
using uint = std::uint32_t;
struct uvec4 {
    uint numbers[4]{};
    uint& operator[](std::size_t k) { return numbers[k]; }
};
struct ivec4 {
    std::int32_t numbers[4]{};
    std::int32_t& operator[](std::size_t k) { return numbers[k]; }
};

#include "backend/vulkan/shaders/layout.glsl"

static_assert(sizeof(ColliderRows) == rows_of_collider * sizeof(vec4));
static_assert(sizeof(LevelNumbers) % sizeof(vec4) == 0);
static_assert(offsetof(SolverBlock, has) % sizeof(vec4) == 0 &&
              offsetof(SolverBlock, levels) % sizeof(vec4) == 0);

}  // namespace pliant::vulkan
