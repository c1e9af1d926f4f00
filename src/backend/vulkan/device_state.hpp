// Device buffers of a running simulation, for drawing without copies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "backend/vulkan/device.hpp"

namespace pliant {

/// Buffers of one cloth, one entry per node.
struct DeviceClothBuffers {
    vk::Buffer position;  ///< vec4: xyz in m, w the inverse mass in 1/kg
    vk::Buffer normal;    ///< vec4: xyz of unit length
    vk::Buffer strain;    ///< float: the largest (l - l0) / l0 of the node's structural and shear springs
    std::uint32_t node_count = 0;
};

class DeviceState {
public:
    virtual ~DeviceState() = default;
    virtual const std::shared_ptr<vulkan::Device>& device() const = 0;
    /// Updates normals and strains to the current positions on the device, and returns the buffers. They stay
    /// the same for the life of the simulation, except `position`, which alternates between two. Cloths are
    /// numbered as the simulation's models; without soft bodies these are the scene's cloths.
    virtual DeviceClothBuffers drawable(std::size_t cloth) = 0;
    /// The `position` of `drawable`, without any update.
    virtual vk::Buffer positions_on_device(std::size_t cloth) const = 0;
};

}  // namespace pliant
