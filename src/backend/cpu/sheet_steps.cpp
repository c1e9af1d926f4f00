#include "backend/cpu/sheet_steps.hpp"

#include <algorithm>
#include <utility>

#include "backend/cpu/pointers.hpp"

namespace pliant::cpu {
namespace {

/// The maximum cost of the second phase's gaps, as a share of all rows: they occupy one thread less.
constexpr std::size_t largest_gap_share = 32;  // 1 / largest_gap_share
constexpr std::ptrdiff_t reach = 2;            // rows that a spring spans

}  // namespace

SheetSteps::SheetSteps(const NodeLayout& layout, std::size_t most_parts) : rows_(layout.rows)
{
    // A row of the last step may be written one pack beyond its end.
    const std::size_t size =
        SheetStretch::carried_size(layout.stride) * SheetStretch::most_steps + 2 * NodeLayout::pad;
    for (std::size_t k = 0; k < most_parts; ++k) carried_.emplace_back(size);
}

std::size_t SheetSteps::most_steps(std::size_t rows, std::size_t parts)
{
    if (parts == 1) return SheetStretch::most_steps;
    const std::size_t by_gaps = 1 + rows / (2 * largest_gap_share * parts);
    const std::size_t by_shrinking = std::max<std::size_t>(1, rows / parts / (2 * reach));
    return std::min({SheetStretch::most_steps, by_gaps, by_shrinking});
}

void SheetSteps::begin() { count_ = 0; }

void SheetSteps::add(PlainCloth<float>& cloth, std::uint32_t parity, const StepConstants<float>& constants,
                     std::span<const Collider> colliders)
{
    const std::uint32_t next = 1 - parity;
    colliders_[count_].assign(colliders.begin(), colliders.end());
    SheetArguments& step = steps_[count_];
    step.layout = &cloth.layout;
    step.position = pointers(std::as_const(cloth.position[parity]));
    step.velocity = pointers(std::as_const(cloth.velocity[parity]));
    step.next_position = pointers(cloth.position[next]);
    step.next_velocity = pointers(cloth.velocity[next]);
    step.external_force = cloth.model.feels_air() ? pointers(std::as_const(cloth.external_force))
                                                  : ConstVectors{nullptr, nullptr, nullptr};
    step.inverse_mass = cloth.inverse_mass.data();
    step.constants = &constants;
    step.colliders = colliders_[count_].data();
    step.collider_count = colliders.size();
    ++count_;
}

void SheetSteps::part(const Kernels& kernels, unsigned phase, std::size_t index, std::size_t parts)
{
    const auto border = [&](std::size_t k) { return static_cast<std::ptrdiff_t>(rows_ * k / parts); };
    std::array<RowRange, SheetStretch::most_steps> ranges{};
    for (std::size_t k = 0; k < count_; ++k) {
        const std::ptrdiff_t gap = reach * static_cast<std::ptrdiff_t>(k);
        if (phase == 0)
            ranges[k] = {index == 0 ? 0 : border(index) + gap,
                         index + 1 == parts ? border(parts) : border(index + 1) - gap};
        else
            ranges[k] = {border(index + 1) - gap, border(index + 1) + gap};
    }
    kernels.sheet_steps({steps_.data(), ranges.data(), count_, carried_[index].data() + NodeLayout::pad});
}

}  // namespace pliant::cpu
