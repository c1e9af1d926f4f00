// A frame of any method as a sequence of passes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/cloth_model.hpp"
#include "solve/pass.hpp"

namespace pliant {

constexpr std::uint32_t no_cloth = ~0u;

/// Appends one frame: `steps` steps of every cloth by its own method and solver, starting from the state copy
/// `parity`, then the measures of the final state. Returns the parity of that state. Every step of the cloth
/// `grabbed` begins with the pull of a hand, see FrameInput::grab. With `only`, just that cloth is stepped
/// and measured.
std::uint32_t append_frame(std::span<const ClothModel> cloths, std::uint32_t steps, std::uint32_t parity,
                           std::vector<Call>& calls, std::uint32_t grabbed = no_cloth,
                           std::uint32_t only = no_cloth);

}  // namespace pliant
