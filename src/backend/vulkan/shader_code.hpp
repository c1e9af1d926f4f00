// SPIR-V of the compute passes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solve/pass.hpp"

namespace pliant::vulkan {

std::span<const std::uint32_t> compute_shader(Pass pass);
/// Several calls of Pass::sheet_step in one dispatch.
std::span<const std::uint32_t> sheet_steps_shader();

/// Both with the device's own inverse square root, and without NoContraction (SimulationOptions::fast_math);
/// empty for a pass without such a module.
std::span<const std::uint32_t> fast_compute_shader(Pass pass);
std::span<const std::uint32_t> fast_sheet_steps_shader();

/// The same module with every sum and product decorated NoContraction. Laws already have it from `precise`;
/// this adds it to the code around them.
std::vector<std::uint32_t> with_exact_arithmetic(std::span<const std::uint32_t> code);

/// Execution modes for 32-bit floats that a device supports (VK_KHR_shader_float_controls).
struct FloatControls {
    bool flush_denormals = false;   ///< DenormFlushToZero; without it, denormals are not flushed on every
                                    ///< machine
    bool round_to_nearest = false;  ///< RoundingModeRTE; without it, Vulkan does not define the rounding mode
};

/// The same module with these modes.
std::vector<std::uint32_t> with_float_controls(std::span<const std::uint32_t> code, FloatControls controls);

}  // namespace pliant::vulkan
