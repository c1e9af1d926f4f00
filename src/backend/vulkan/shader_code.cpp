// SPIR-V of the compute passes, embedded at build time: NAME.comp of the folder shaders for each PASS(NAME).
#include "backend/vulkan/shader_code.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

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
constexpr std::uint32_t sheet_steps[] = {
#include "shaders/sheet_steps.comp.inc"
};
constexpr std::uint32_t attach[] = {
#include "shaders/attach.comp.inc"
};
constexpr std::uint32_t grab[] = {
#include "shaders/grab.comp.inc"
};
constexpr std::uint32_t spring_force[] = {
#include "shaders/spring_force.comp.inc"
};
constexpr std::uint32_t list_step[] = {
#include "shaders/list_step.comp.inc"
};
constexpr std::uint32_t stage_step[] = {
#include "shaders/stage_step.comp.inc"
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
constexpr std::uint32_t load_force[] = {
#include "shaders/load_force.comp.inc"
};
constexpr std::uint32_t ring_step[] = {
#include "shaders/ring_step.comp.inc"
};
constexpr std::uint32_t volume_gather[] = {
#include "shaders/volume_gather.comp.inc"
};
constexpr std::uint32_t volume_step[] = {
#include "shaders/volume_step.comp.inc"
};
constexpr std::uint32_t volume_cubic[] = {
#include "shaders/volume_cubic.comp.inc"
};
constexpr std::uint32_t volume_correct[] = {
#include "shaders/volume_correct.comp.inc"
};
constexpr std::uint32_t volume_measure[] = {
#include "shaders/volume_measure.comp.inc"
};
constexpr std::uint32_t volume_total[] = {
#include "shaders/volume_total.comp.inc"
};
constexpr std::uint32_t solve_reset[] = {
#include "shaders/solve_reset.comp.inc"
};
constexpr std::uint32_t step_begin[] = {
#include "shaders/step_begin.comp.inc"
};
constexpr std::uint32_t sheet_gather[] = {
#include "shaders/sheet_gather.comp.inc"
};
constexpr std::uint32_t solve_begin[] = {
#include "shaders/solve_begin.comp.inc"
};
constexpr std::uint32_t sheet_coarsen[] = {
#include "shaders/sheet_coarsen.comp.inc"
};
constexpr std::uint32_t bottom_factor[] = {
#include "shaders/bottom_factor.comp.inc"
};
constexpr std::uint32_t linear_begin[] = {
#include "shaders/linear_begin.comp.inc"
};
constexpr std::uint32_t linear_start[] = {
#include "shaders/linear_start.comp.inc"
};
constexpr std::uint32_t level_smooth[] = {
#include "shaders/level_smooth.comp.inc"
};
constexpr std::uint32_t level_residual[] = {
#include "shaders/level_residual.comp.inc"
};
constexpr std::uint32_t sheet_restrict[] = {
#include "shaders/sheet_restrict.comp.inc"
};
constexpr std::uint32_t bottom_solve[] = {
#include "shaders/bottom_solve.comp.inc"
};
constexpr std::uint32_t sheet_prolong[] = {
#include "shaders/sheet_prolong.comp.inc"
};
constexpr std::uint32_t linear_jacobi[] = {
#include "shaders/linear_jacobi.comp.inc"
};
constexpr std::uint32_t linear_plain[] = {
#include "shaders/linear_plain.comp.inc"
};
constexpr std::uint32_t linear_beta[] = {
#include "shaders/linear_beta.comp.inc"
};
constexpr std::uint32_t linear_direction[] = {
#include "shaders/linear_direction.comp.inc"
};
constexpr std::uint32_t linear_apply[] = {
#include "shaders/linear_apply.comp.inc"
};
constexpr std::uint32_t linear_alpha[] = {
#include "shaders/linear_alpha.comp.inc"
};
constexpr std::uint32_t linear_update[] = {
#include "shaders/linear_update.comp.inc"
};
constexpr std::uint32_t linear_check[] = {
#include "shaders/linear_check.comp.inc"
};
constexpr std::uint32_t search_begin[] = {
#include "shaders/search_begin.comp.inc"
};
constexpr std::uint32_t newton_move[] = {
#include "shaders/newton_move.comp.inc"
};
constexpr std::uint32_t search_move[] = {
#include "shaders/search_move.comp.inc"
};
constexpr std::uint32_t search_check[] = {
#include "shaders/search_check.comp.inc"
};
constexpr std::uint32_t newton_check[] = {
#include "shaders/newton_check.comp.inc"
};
constexpr std::uint32_t contact_change[] = {
#include "shaders/contact_change.comp.inc"
};
constexpr std::uint32_t contact_check[] = {
#include "shaders/contact_check.comp.inc"
};
constexpr std::uint32_t contact_keep[] = {
#include "shaders/contact_keep.comp.inc"
};
constexpr std::uint32_t contact_resume[] = {
#include "shaders/contact_resume.comp.inc"
};
constexpr std::uint32_t newton_polish[] = {
#include "shaders/newton_polish.comp.inc"
};
constexpr std::uint32_t sheet_multiply[] = {
#include "shaders/sheet_multiply.comp.inc"
};
constexpr std::uint32_t mesh_multiply[] = {
#include "shaders/mesh_multiply.comp.inc"
};
constexpr std::uint32_t step_end[] = {
#include "shaders/step_end.comp.inc"
};
constexpr std::uint32_t solve_end[] = {
#include "shaders/solve_end.comp.inc"
};
constexpr std::uint32_t mesh_springs[] = {
#include "shaders/mesh_springs.comp.inc"
};
constexpr std::uint32_t mesh_fold[] = {
#include "shaders/mesh_fold.comp.inc"
};
constexpr std::uint32_t mesh_gather[] = {
#include "shaders/mesh_gather.comp.inc"
};
constexpr std::uint32_t mesh_coarsen_couplings[] = {
#include "shaders/mesh_coarsen_couplings.comp.inc"
};
constexpr std::uint32_t mesh_coarsen_nodes[] = {
#include "shaders/mesh_coarsen_nodes.comp.inc"
};
constexpr std::uint32_t mesh_bottom_factor[] = {
#include "shaders/mesh_bottom_factor.comp.inc"
};
constexpr std::uint32_t mesh_apply[] = {
#include "shaders/mesh_apply.comp.inc"
};
constexpr std::uint32_t mesh_smooth[] = {
#include "shaders/mesh_smooth.comp.inc"
};
constexpr std::uint32_t mesh_residual[] = {
#include "shaders/mesh_residual.comp.inc"
};
constexpr std::uint32_t mesh_restrict[] = {
#include "shaders/mesh_restrict.comp.inc"
};
constexpr std::uint32_t mesh_prolong[] = {
#include "shaders/mesh_prolong.comp.inc"
};
constexpr std::uint32_t paper_begin[] = {
#include "shaders/paper_begin.comp.inc"
};
constexpr std::uint32_t paper_springs[] = {
#include "shaders/paper_springs.comp.inc"
};
constexpr std::uint32_t paper_gather[] = {
#include "shaders/paper_gather.comp.inc"
};
constexpr std::uint32_t paper_count[] = {
#include "shaders/paper_count.comp.inc"
};
constexpr std::uint32_t paper_scan[] = {
#include "shaders/paper_scan.comp.inc"
};
constexpr std::uint32_t paper_list[] = {
#include "shaders/paper_list.comp.inc"
};
constexpr std::uint32_t paper_system[] = {
#include "shaders/paper_system.comp.inc"
};
constexpr std::uint32_t paper_start[] = {
#include "shaders/paper_start.comp.inc"
};
constexpr std::uint32_t paper_apply[] = {
#include "shaders/paper_apply.comp.inc"
};
constexpr std::uint32_t paper_alpha[] = {
#include "shaders/paper_alpha.comp.inc"
};
constexpr std::uint32_t paper_update[] = {
#include "shaders/paper_update.comp.inc"
};
constexpr std::uint32_t paper_check[] = {
#include "shaders/paper_check.comp.inc"
};
constexpr std::uint32_t paper_direction[] = {
#include "shaders/paper_direction.comp.inc"
};
constexpr std::uint32_t paper_multipliers[] = {
#include "shaders/paper_multipliers.comp.inc"
};
constexpr std::uint32_t paper_step[] = {
#include "shaders/paper_step.comp.inc"
};
constexpr std::uint32_t paper_end[] = {
#include "shaders/paper_end.comp.inc"
};

constexpr std::uint32_t mesh_limits[] = {
#include "shaders/mesh_limits.comp.inc"
};

constexpr std::uint32_t mesh_marks[] = {
#include "shaders/mesh_marks.comp.inc"
};
constexpr std::uint32_t mesh_clear[] = {
#include "shaders/mesh_clear.comp.inc"
};
constexpr std::uint32_t mesh_clear_edges[] = {
#include "shaders/mesh_clear_edges.comp.inc"
};
constexpr std::uint32_t mesh_live[] = {
#include "shaders/mesh_live.comp.inc"
};

constexpr std::uint32_t mesh_multipliers[] = {
#include "shaders/mesh_multipliers.comp.inc"
};

constexpr std::uint32_t sheet_limits[] = {
#include "shaders/sheet_limits.comp.inc"
};

constexpr std::uint32_t acad_check[] = {
#include "shaders/acad_check.comp.inc"
};

constexpr std::uint32_t sheet_marks[] = {
#include "shaders/sheet_marks.comp.inc"
};
constexpr std::uint32_t sheet_clear[] = {
#include "shaders/sheet_clear.comp.inc"
};
constexpr std::uint32_t sheet_live[] = {
#include "shaders/sheet_live.comp.inc"
};

constexpr std::uint32_t acad_begin[] = {
#include "shaders/acad_begin.comp.inc"
};

constexpr std::uint32_t acad_end[] = {
#include "shaders/acad_end.comp.inc"
};

constexpr std::uint32_t sheet_multipliers[] = {
#include "shaders/sheet_multipliers.comp.inc"
};

constexpr std::uint32_t paper_export[] = {
#include "shaders/paper_export.comp.inc"
};

// The same for SimulationOptions::fast_math: those of PLIANT_FAST_SHADERS (cmake/PliantShaders.cmake).
namespace fast {
constexpr std::uint32_t sheet_steps[] = {
#include "shaders/fast/sheet_steps.comp.inc"
};
constexpr std::uint32_t sheet_step[] = {
#include "shaders/fast/sheet_step.comp.inc"
};
constexpr std::uint32_t spring_force[] = {
#include "shaders/fast/spring_force.comp.inc"
};
constexpr std::uint32_t list_step[] = {
#include "shaders/fast/list_step.comp.inc"
};
constexpr std::uint32_t stage_step[] = {
#include "shaders/fast/stage_step.comp.inc"
};
constexpr std::uint32_t ring_step[] = {
#include "shaders/fast/ring_step.comp.inc"
};
constexpr std::uint32_t volume_gather[] = {
#include "shaders/fast/volume_gather.comp.inc"
};
constexpr std::uint32_t volume_step[] = {
#include "shaders/fast/volume_step.comp.inc"
};
constexpr std::uint32_t volume_cubic[] = {
#include "shaders/fast/volume_cubic.comp.inc"
};
constexpr std::uint32_t volume_correct[] = {
#include "shaders/fast/volume_correct.comp.inc"
};
}  // namespace fast

constexpr std::span<const std::uint32_t> codes[] = {
#define PASS(name, ...) name,
#include "solve/passes.def"
#undef PASS
};

}  // namespace

std::span<const std::uint32_t> compute_shader(Pass pass) { return codes[static_cast<std::size_t>(pass)]; }
std::span<const std::uint32_t> sheet_steps_shader() { return sheet_steps; }

std::span<const std::uint32_t> fast_compute_shader(Pass pass)
{
    switch (pass) {
        case Pass::sheet_step: return fast::sheet_step;
        case Pass::spring_force: return fast::spring_force;
        case Pass::list_step: return fast::list_step;
        case Pass::stage_step: return fast::stage_step;
        case Pass::ring_step: return fast::ring_step;
        case Pass::volume_gather: return fast::volume_gather;
        case Pass::volume_step: return fast::volume_step;
        case Pass::volume_cubic: return fast::volume_cubic;
        case Pass::volume_correct: return fast::volume_correct;
        default: return {};
    }
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
    std::size_t types = 0;  // where annotations end
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
    // Before SPIR-V 1.4 both are an extension's, whose name is a string of its own length in words.
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
