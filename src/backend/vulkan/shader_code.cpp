// SPIR-V of the compute passes, embedded at build time: of each row of solve/passes.def, and of
// sheet_steps.comp.
#include "backend/vulkan/shader_code.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

namespace pliant::vulkan {
namespace {

// NAME[] and fast::NAME[], written by cmake/PliantShaders.cmake.
#include "shaders/modules.inc"

constexpr std::span<const std::uint32_t> modules[] = {
#define PASS(name, ...) name,
#include "solve/passes.def"
};

constexpr std::span<const std::uint32_t> fast_modules[] = {
#define MODULE_fast(name) fast::name
#define MODULE_exact(name) \
    {                      \
    }
#define CLOTH_PASS(name, unit, layout, math, ...) MODULE_##math(name),
#define BODY_PASS(name, unit, layout, math, ...) MODULE_##math(name),
#define PASS(name, ...) MODULE_exact(name),
#include "solve/passes.def"
#undef MODULE_fast
#undef MODULE_exact
};

}  // namespace

std::span<const std::uint32_t> compute_shader(Pass pass) { return modules[static_cast<std::size_t>(pass)]; }
std::span<const std::uint32_t> sheet_steps_shader() { return sheet_steps; }
std::span<const std::uint32_t> fast_compute_shader(Pass pass)
{
    return fast_modules[static_cast<std::size_t>(pass)];
}
std::span<const std::uint32_t> fast_sheet_steps_shader() { return fast::sheet_steps; }

std::vector<std::uint32_t> with_exact_arithmetic(std::span<const std::uint32_t> code)
{
    constexpr std::uint32_t header_words = 5, op_decorate = 71, no_contraction = 42;
    constexpr std::uint32_t first_of_types = 19, last_of_types = 39;
    constexpr std::uint32_t sums_and_products[] = {129, 131, 133,
                                                   142};  // OpFAdd, OpFSub, OpFMul, OpVectorTimesScalar
    std::vector<std::uint32_t> results;
    std::set<std::uint32_t> decorated;
    std::size_t types = 0;  // the end of the annotations
    for (std::size_t at = header_words; at < code.size(); at += code[at] >> 16) {
        const std::uint32_t op = code[at] & 0xffff;
        if (op == op_decorate && code[at + 2] == no_contraction) decorated.insert(code[at + 1]);
        if (types == 0 && op >= first_of_types && op <= last_of_types) types = at;
        if (std::find(std::begin(sums_and_products), std::end(sums_and_products), op) !=
            std::end(sums_and_products))
            results.push_back(code[at + 2]);
    }
    std::vector<std::uint32_t> result(code.begin(), code.begin() + static_cast<std::ptrdiff_t>(types));
    for (const std::uint32_t id : results)
        if (decorated.insert(id).second)
            result.insert(result.end(), {3u << 16 | op_decorate, id, no_contraction});
    result.insert(result.end(), code.begin() + static_cast<std::ptrdiff_t>(types), code.end());
    return result;
}

std::vector<std::uint32_t> with_float_controls(std::span<const std::uint32_t> code, FloatControls controls)
{
    constexpr std::uint32_t header_words = 5, op_extension = 10, op_entry_point = 15, op_execution_mode = 16,
                            op_capability = 17;
    constexpr std::uint32_t float_bits = 32;
    struct Mode {
        bool wanted;
        std::uint32_t capability, mode;
    };
    const Mode modes[] = {{controls.flush_denormals, 4465, 4460},    // DenormFlushToZero
                          {controls.round_to_nearest, 4467, 4462}};  // RoundingModeRTE
    // Before SPIR-V 1.4 both belong to an extension, whose name is a string with its length in words.
    constexpr char extension_name[] = "SPV_KHR_float_controls";
    std::array<std::uint32_t, 1 + (sizeof extension_name + 3) / 4> extension{};
    extension[0] = static_cast<std::uint32_t>(extension.size()) << 16 | op_extension;
    std::memcpy(&extension[1], extension_name, sizeof extension_name);

    std::vector<std::uint32_t> result(code.begin(), code.begin() + header_words);
    bool capabilities_done = false;
    for (std::size_t at = header_words; at < code.size();) {
        const std::uint32_t op = code[at] & 0xffff, words = code[at] >> 16;
        if (!capabilities_done && op != op_capability) {
            for (const Mode& mode : modes)
                if (mode.wanted) result.insert(result.end(), {2u << 16 | op_capability, mode.capability});
            if (controls.flush_denormals || controls.round_to_nearest)
                result.insert(result.end(), extension.begin(), extension.end());
            capabilities_done = true;
        }
        result.insert(result.end(), code.begin() + static_cast<std::ptrdiff_t>(at),
                      code.begin() + static_cast<std::ptrdiff_t>(at + words));
        if (op == op_entry_point)
            for (const Mode& mode : modes)
                if (mode.wanted)
                    result.insert(result.end(),
                                  {4u << 16 | op_execution_mode, code[at + 2], mode.mode, float_bits});
        at += words;
    }
    return result;
}

}  // namespace pliant::vulkan
