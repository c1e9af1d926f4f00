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

/// Both with the device's own inverse square root and nothing decorated NoContraction
/// (SimulationOptions::fast_math); empty of a pass that has no such module.
std::span<const std::uint32_t> fast_compute_shader(Pass pass);
std::span<const std::uint32_t> fast_sheet_steps_shader();

/// The same module with every sum and product decorated NoContraction. Laws have it from their own text
/// (`precise`); this gives it to what is written around them.
std::vector<std::uint32_t> with_exact_arithmetic(std::span<const std::uint32_t> code);

/// Execution modes for 32-bit floats that a device offers (VK_KHR_shader_float_controls).
struct FloatControls {
    bool flush_denormals = false;  ///< DenormFlushToZero: denormals are flushed on every machine
    bool round_to_nearest =
        false;  ///< RoundingModeRTE: without it, Vulkan leaves the direction of rounding open
};

/// The same module with these modes.
std::vector<std::uint32_t> with_float_controls(std::span<const std::uint32_t> code, FloatControls controls);

}  // namespace pliant::vulkan
