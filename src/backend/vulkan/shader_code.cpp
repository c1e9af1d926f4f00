// SPIR-V of the compute passes, embedded at build time: NAME.comp of the folder shaders for each PASS(NAME).
#include "backend/vulkan/shader_code.hpp"

namespace pliant::vulkan {
namespace {

constexpr std::uint32_t sheet_wind[] = {
#include "shaders/sheet_wind.comp.inc"
};
constexpr std::uint32_t mesh_wind[] = {
#include "shaders/mesh_wind.comp.inc"
};
constexpr std::uint32_t sheet_step[] = {
#include "shaders/sheet_step.comp.inc"
};
constexpr std::uint32_t spring_force[] = {
#include "shaders/spring_force.comp.inc"
};
constexpr std::uint32_t list_step[] = {
#include "shaders/list_step.comp.inc"
};
constexpr std::uint32_t sheet_measure[] = {
#include "shaders/sheet_measure.comp.inc"
};
constexpr std::uint32_t list_measure[] = {
#include "shaders/list_measure.comp.inc"
};
constexpr std::uint32_t measure_merge[] = {
#include "shaders/measure_merge.comp.inc"
};
constexpr std::uint32_t sheet_normal[] = {
#include "shaders/sheet_normal.comp.inc"
};
constexpr std::uint32_t mesh_normal[] = {
#include "shaders/mesh_normal.comp.inc"
};
constexpr std::uint32_t sheet_strain[] = {
#include "shaders/sheet_strain.comp.inc"
};
constexpr std::uint32_t list_strain[] = {
#include "shaders/list_strain.comp.inc"
};

constexpr std::span<const std::uint32_t> codes[] = {
#define PASS(name, ...) name,
#include "solve/passes.def"
#undef PASS
};

}  // namespace

std::span<const std::uint32_t> compute_shader(Pass pass) { return codes[static_cast<std::size_t>(pass)]; }

std::vector<std::uint32_t> with_float_controls(std::span<const std::uint32_t> code, FloatControls controls)
{
    constexpr std::uint32_t header_words = 5, op_entry_point = 15, op_execution_mode = 16, op_capability = 17;
    constexpr std::uint32_t float_bits = 32;
    struct Mode {
        bool wanted;
        std::uint32_t capability, mode;
    };
    const Mode modes[] = {{controls.flush_denormals, 4465, 4460},    // DenormFlushToZero
                          {controls.round_to_nearest, 4467, 4462}};  // RoundingModeRTE

    std::vector<std::uint32_t> result(code.begin(), code.begin() + header_words);
    bool capabilities_done = false;
    for (std::size_t at = header_words; at < code.size();) {
        const std::uint32_t op = code[at] & 0xffff, words = code[at] >> 16;
        if (!capabilities_done && op != op_capability) {
            for (const Mode& mode : modes)
                if (mode.wanted) result.insert(result.end(), {2u << 16 | op_capability, mode.capability});
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
