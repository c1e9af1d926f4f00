// Device buffers of soft bodies besides the state of their nodes.
#pragma once

#include <vector>

#include "backend/vulkan/device.hpp"
#include "body/cloth_model.hpp"
#include "solve/pass.hpp"

namespace pliant::vulkan {

class BodyBuffers {
public:
    /// Empty buffers for a cloth.
    BodyBuffers(const Device& device, const ClothModel& model);

    /// Work groups of a call of a body's pass.
    std::uint32_t groups_of(const Call& call) const;
    /// Records a copy of the measured volumes to a buffer that the host reads.
    void record_volume_copy(const vk::raii::CommandBuffer& commands) const;
    double volume(std::size_t body) const;  ///< 6 V, m3

    const Buffer& topology() const { return topology_; }
    const Buffer& gradient() const { return gradient_; }
    const Buffer& direction() const { return direction_; }
    const Buffer& blocked() const { return blocked_; }
    const Buffer& sums() const { return sums_; }

    /// Where the values of a resource begin in `sums`, in rows of four numbers.
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
