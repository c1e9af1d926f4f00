// The requirements of a compute shader, read from its SPIR-V.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pliant/api.hpp"

namespace pliant::vulkan {

struct ShaderNeeds {
    std::vector<std::uint32_t> storage_buffers, uniform_buffers;  ///< bindings that it uses, ascending
    std::vector<std::uint32_t> read_buffers, written_buffers;     ///< of the storage buffers
    std::array<std::uint32_t, 3> group_size{1, 1, 1};
    std::uint64_t shared_memory = 0;   ///< bytes
    std::uint64_t push_constants = 0;  ///< bytes
    std::uint64_t uniform_range = 0;   ///< bytes of the largest uniform block

    std::uint64_t invocations() const { return std::uint64_t{group_size[0]} * group_size[1] * group_size[2]; }
};

/// With the numbers that its constants 0, 1, ... are set to. What no function reaches that is called counts
/// for nothing: includes declare more than a shader uses.
PLIANT_INSIDE ShaderNeeds needs_of(std::span<const std::uint32_t> code,
                                   std::span<const std::uint32_t> constants = {});

}  // namespace pliant::vulkan
