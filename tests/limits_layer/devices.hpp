// What named devices report, as far as Pliant asks for it: the one table of the layer of limits.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace pliant::limits {

/// Whether shaders may ask for a float's rounding and for denormals to be flushed.
struct FloatControls {
    bool offered = false;           ///< by VK_KHR_shader_float_controls, or by Vulkan 1.2
    bool flush_denormals = false;   ///< shaderDenormFlushToZeroFloat32
    bool round_to_nearest = false;  ///< shaderRoundingModeRTEFloat32
};

/// Limits under the names that Vulkan has for them, in brackets.
struct TestDevice {
    const char* name;    ///< in PLIANT_TEST_DEVICE, and part of the name that Vulkan reports
    const char* model;   ///< for people
    const char* source;  ///< where the numbers come from
    std::uint32_t api_version;
    std::uint32_t stage_storage_buffers;  ///< (maxPerStageDescriptorStorageBuffers)
    std::uint32_t set_storage_buffers;    ///< (maxDescriptorSetStorageBuffers)
    std::uint32_t stage_resources;        ///< (maxPerStageResources)
    std::uint32_t
        buffer_slots;  ///< uniform, storage and push constants of a stage together; 0: no such limit
    std::uint32_t storage_range;      ///< (maxStorageBufferRange) bytes
    std::uint32_t storage_alignment;  ///< (minStorageBufferOffsetAlignment) bytes
    std::uint32_t push_constants;     ///< (maxPushConstantsSize) bytes
    std::uint32_t allocations;        ///< (maxMemoryAllocationCount)
    std::uint32_t shared_memory;      ///< (maxComputeSharedMemorySize) bytes
    std::uint32_t invocations;        ///< (maxComputeWorkGroupInvocations)
    std::uint32_t group_size[3];      ///< (maxComputeWorkGroupSize)
    std::uint32_t group_count[3];     ///< (maxComputeWorkGroupCount)
    FloatControls floats;
    bool wires;        ///< (fillModeNonSolid)
    bool portability;  ///< seen only by those who ask for portability (VK_KHR_portability_enumeration,
                       ///< _subset)
};

std::span<const TestDevice> test_devices();

/// Null when no device has that name.
const TestDevice* find_test_device(std::string_view name);

}  // namespace pliant::limits
