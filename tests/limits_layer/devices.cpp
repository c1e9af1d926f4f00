#include "devices.hpp"

#include <vulkan/vulkan.h>

namespace pliant::limits {
namespace {

constexpr std::uint32_t kibibyte = 1u << 10, mebibyte = 1u << 20, no_bound = UINT32_MAX;

// Where a source does not have a number, the least that Vulkan allows stands for it ("required minimum": 128
// bytes of push constants, 4096 allocations, 65535 groups, an alignment of 256), so that a device is never
// taken for better than it is. Reports are those of vulkan.gpuinfo.org; [P] is KhronosGroup/Vulkan-Profiles,
// which keeps some of them, [A] azhirnov/as-en (AE/engine/shared_data/feature_set), which keeps what is
// common to several devices.
constexpr TestDevice devices[] = {
    {.name = "quest3",
     .model = "Quest 3 (Adreno 740)",
     // Quest headsets report 1.1 with older system software, 1.3 with newer; the harder of the two is tested.
     // The float controls are what Mesa's driver offers for the chip.
     .source =
         "[A] min_mobile_vr.as (Quest 3, Pico 4): buffers, range, push constants, shared memory, groups; "
         "required minimum: allocations, counts of groups, alignment",
     .api_version = VK_API_VERSION_1_1,
     .stage_storage_buffers = 524288,
     .set_storage_buffers = 524288,
     .stage_resources = 1572864,
     .buffer_slots = 0,
     .storage_range = 128 * mebibyte,
     .storage_alignment = 256,
     .push_constants = 128,
     .allocations = 4096,
     .shared_memory = 32 * kibibyte,
     .invocations = 1024,
     .group_size = {1024, 1024, 64},
     .group_count = {65535, 65535, 65535},
     .floats = {true, true, true},
     .wires = true,
     .portability = false},
    {.name = "mali_g78",
     .model = "Mali-G78",
     // No stored report of this chip was at hand.
     .source =
         "512 invocations, 256 MiB, 32 KiB: as the project's requirements state them; 35 storage buffers as "
         "Mali's OpenGL ES has (github.com/gpuweb/gpuweb/issues/5125); float controls as of mali_g57; "
         "required minimum: the rest",
     .api_version = VK_API_VERSION_1_1,
     .stage_storage_buffers = 35,
     .set_storage_buffers = 35,
     .stage_resources = 128,
     .buffer_slots = 0,
     .storage_range = 256 * mebibyte,
     .storage_alignment = 256,
     .push_constants = 128,
     .allocations = 4096,
     .shared_memory = 32 * kibibyte,
     .invocations = 512,
     .group_size = {512, 512, 512},
     .group_count = {65535, 65535, 65535},
     .floats = {true, true, true},
     .wires = false,
     .portability = false},
    {.name = "mali_g57",
     .model = "Mali-G57, driver r51p0",
     .source =
         "vulkaninfo of a tablet, driver v1.r51p0-00eac0: version, push constants, alignment, shared memory, "
         "groups, float controls; 35 storage buffers as of mali_g78; required minimum: range, allocations",
     .api_version = VK_API_VERSION_1_3,
     .stage_storage_buffers = 35,
     .set_storage_buffers = 35,
     .stage_resources = 128,
     .buffer_slots = 0,
     .storage_range = 128 * mebibyte,
     .storage_alignment = 64,
     .push_constants = 256,
     .allocations = 4096,
     .shared_memory = 32 * kibibyte,
     .invocations = 512,
     .group_size = {512, 512, 512},
     .group_count = {no_bound, no_bound, no_bound},
     .floats = {true, true, true},
     .wires = false,
     .portability = false},
    {.name = "adreno_610",
     .model = "Adreno 610, least of the 6xx, with the buffers of an Adreno 5xx",
     .source =
         "[A] min_mobile_adreno.as (505, 610, 612, 660, 730): 24 storage buffers, 158 resources, range, push "
         "constants, groups; 16 KiB of shared memory: github.com/gpuweb/gpuweb/issues/2832; required "
         "minimum: "
         "the rest; no float controls assumed",
     .api_version = VK_API_VERSION_1_1,
     .stage_storage_buffers = 24,
     .set_storage_buffers = 24,
     .stage_resources = 158,
     .buffer_slots = 0,
     .storage_range = 128 * mebibyte,
     .storage_alignment = 256,
     .push_constants = 128,
     .allocations = 4096,
     .shared_memory = 16 * kibibyte,
     .invocations = 512,
     .group_size = {512, 512, 64},
     .group_count = {65535, 65535, 65535},
     .floats = {},
     .wires = true,
     .portability = false},
    {.name = "apple_m1",
     .model = "Apple M1 by MoltenVK 1.1.3",
     // A Metal stage has 31 places for buffers of all kinds together, whatever Vulkan can say of it.
     .source = "[P] vp_gpuinfo_apple_m1_0_2_1911_osx_11_2.json; the size of a group from a later report "
               "(github.com/gfx-rs/wgpu/issues/5551)",
     .api_version = VK_API_VERSION_1_1,
     .stage_storage_buffers = 31,
     .set_storage_buffers = 155,
     .stage_resources = 159,
     .buffer_slots = 31,
     .storage_range = no_bound,
     .storage_alignment = 16,
     .push_constants = 4096,
     .allocations = 1073741824,
     .shared_memory = 32 * kibibyte,
     .invocations = 1024,
     .group_size = {1024, 1024, 1024},
     .group_count = {1073741824, 1073741824, 1073741824},
     .floats = {},
     .wires = true,
     .portability = true},
    {.name = "iris_xe",
     .model = "Intel Iris Xe (TGL GT2) by Mesa 26.1.3",
     .source = "[P] vp_gpuinfo_intel_r__iris_r__xe_graphics__tgl_gt2__26_1_3_void_unknown.json",
     .api_version = VK_API_VERSION_1_3,
     .stage_storage_buffers = 201326592,
     .set_storage_buffers = 201326592,
     .stage_resources = 201326592,
     .buffer_slots = 0,
     .storage_range = no_bound,
     .storage_alignment = 4,
     .push_constants = 256,
     .allocations = no_bound,
     .shared_memory = 48 * kibibyte,
     .invocations = 1024,
     .group_size = {1024, 1024, 1024},
     .group_count = {2147483647, 65535, 65535},
     .floats = {true, true, true},
     .wires = true,
     .portability = false},
};

/// A made-up device that has enough of everything; the tiny ones below lack one thing each.
constexpr TestDevice enough(const char* name, const char* model)
{
    TestDevice device = devices[0];
    device.name = name;
    device.model = model;
    device.source = "made up";
    return device;
}

constexpr TestDevice with(TestDevice device, std::uint32_t TestDevice::*limit, std::uint32_t value)
{
    device.*limit = value;
    return device;
}

constexpr TestDevice with_groups_of(TestDevice device, std::uint32_t along_x)
{
    device.group_size[0] = along_x;
    return device;
}

constexpr TestDevice tiny_devices[] = {
    with(enough("tiny_version", "made up: Vulkan 1.0"), &TestDevice::api_version, VK_API_VERSION_1_0),
    with(enough("tiny_stage_buffers", "made up: 4 storage buffers in a stage"),
         &TestDevice::stage_storage_buffers, 4),
    with(enough("tiny_set_buffers", "made up: 4 storage buffers in a set"), &TestDevice::set_storage_buffers,
         4),
    with(enough("tiny_invocations", "made up: 128 invocations in a group"), &TestDevice::invocations, 128),
    with_groups_of(enough("tiny_group", "made up: groups of 128 along x"), 128),
    with(enough("tiny_shared", "made up: 4 KiB of shared memory"), &TestDevice::shared_memory, 4 * kibibyte),
    with(enough("tiny_push", "made up: 4 bytes of push constants"), &TestDevice::push_constants, 4),
    with(enough("tiny_range", "made up: storage buffers of 64 KiB"), &TestDevice::storage_range,
         64 * kibibyte),
    with(enough("tiny_allocations", "made up: 1 allocation"), &TestDevice::allocations, 1),
    with(enough("no_allocations", "made up: no memory at all"), &TestDevice::allocations, 0),
    with(enough("tiny_slots", "made up: 4 places for buffers in a stage"), &TestDevice::buffer_slots, 4),
};

}  // namespace

std::span<const TestDevice> test_devices() { return devices; }

const TestDevice* find_test_device(std::string_view name)
{
    for (const std::span<const TestDevice> list : {std::span<const TestDevice>(devices), {tiny_devices}})
        for (const TestDevice& device : list)
            if (name == device.name) return &device;
    return nullptr;
}

}  // namespace pliant::limits
