// Several steps of a sheet in one pass over its rows, so that its state is read from memory only once.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "backend/cpu/kernels.hpp"
#include "backend/host/plain_cloth.hpp"

namespace pliant::cpu {

/// Threads share the rows in two phases. Step k needs two rows more than it computes. In the first phase a
/// part's rows therefore shrink from step to step by two at every shared side, and no part waits for another.
/// The second phase fills the gaps, which grow by as much ("split tiling"; Grosser et al., "Split tiling for
/// GPUs", 2013).
class SheetSteps {
public:
    using Collider = Laws<float>::Collider;

    /// For up to `most_parts` parts of a sheet.
    SheetSteps(const NodeLayout& layout, std::size_t most_parts);

    /// How many steps to take at once with `parts` parts.
    static std::size_t most_steps(std::size_t rows, std::size_t parts);

    void begin();
    void add(PlainCloth<float>& cloth, std::uint32_t parity, const StepConstants<float>& constants,
             std::span<const Collider> colliders);
    std::size_t count() const { return count_; }

    /// Phase 0 has `parts` parts, phase 1 one less. Parts of a phase may run concurrently.
    void part(const Kernels& kernels, unsigned phase, std::size_t index, std::size_t parts);

private:
    std::size_t rows_;
    std::vector<AlignedArray<float>> carried_;  // by part
    std::array<SheetArguments, SheetStretch::most_steps> steps_{};
    std::array<std::vector<Collider>, SheetStretch::most_steps> colliders_;
    std::size_t count_ = 0;
};

}  // namespace pliant::cpu
