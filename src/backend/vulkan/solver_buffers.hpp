// The constraint solver of one cloth on the device.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "backend/vulkan/device.hpp"
#include "body/cloth_model.hpp"
#include "solve/pass.hpp"
#include "solve/solver_constants.hpp"

namespace pliant::vulkan {

/// Work groups of a call in x and y.
struct Groups {
    std::uint64_t x = 0, y = 1;
};

/// Why the arena of a cloth exceeds one buffer of `most` bytes, and how many nodes would fit; empty if it
/// fits.
std::string arena_refusal(const ClothModel& model, const std::string& device, std::uint64_t most);

/// Empty if the cloth's hierarchy is empty.
class SolverBuffers {
public:
    /// Throws Error(device_failure) if the device's buffers are too small for the arena.
    SolverBuffers(const Device& device, const ClothModel& model);

    Groups groups_of(const Call& call) const;
    void set_constants(double step_length);

    const Buffer& constants() const { return constants_; }
    const Buffer& arena() const { return arena_; }
    const Buffer& scalars() const { return scalars_; }
    const Buffer& parts() const { return parts_; }
    const Buffer& topology() const { return topology_; }
    const Buffer& multiplier() const { return multiplier_; }

    /// Whether calls of this guard are skipped, according to the last copy of the scalars.
    bool skips(Guard guard) const;
    /// Records a copy of the scalars to a buffer that the host reads.
    void record_scalar_copy(const vk::raii::CommandBuffer& commands) const;
    double scalar(std::size_t number) const;

private:
    Groups groups_on(std::int32_t rows, std::int32_t columns) const;

    const ClothModel* model_;
    SumParts sum_parts_;
    Buffer constants_, arena_, scalars_, scalar_copy_, parts_, topology_, multiplier_;
};

}  // namespace pliant::vulkan
