// What soft bodies have on the device beside the state of their nodes.
#pragma once

#include <vector>

#include "backend/vulkan/device.hpp"
#include "body/cloth_model.hpp"
#include "solve/pass.hpp"

namespace pliant::vulkan {

class BodyBuffers {
public:
    /// Buffers of no size for a cloth.
    BodyBuffers(const Device& device, const ClothModel& model);

    /// Work groups of a call of a body's pass.
    std::uint32_t groups_of(const Call& call) const;
    /// Appends the copy of the measured volumes to where the host reads them.
    void record_volume_copy(const vk::raii::CommandBuffer& commands) const;
    void volumes(std::vector<double>& values) const;  ///< 6 V, m3

    const Buffer& topology() const { return topology_; }
    const Buffer& gradient() const { return gradient_; }
    const Buffer& direction() const { return direction_; }
    const Buffer& blocked() const { return blocked_; }
    const Buffer& sums() const { return sums_; }

    /// Where the values of a resource lie in `sums`, in rows of four numbers.
    struct Rows {
        std::uint32_t first = 0, count = 0;
    };
    Rows rows_of(Resource resource) const;

private:
    const BodyModel* body_ = nullptr;
    Rows rate_sums_, cubic_sums_, records_, volumes_;
    Buffer topology_, gradient_, direction_, blocked_, sums_, read_volumes_;
};

}  // namespace pliant::vulkan
