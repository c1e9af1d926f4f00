// The shadow map: a depth image from the sun, and its render pass.
#pragma once

#include "render/device_image.hpp"

namespace pliant::vulkan {

class ShadowMap {
public:
    static constexpr std::uint32_t edge = 2048;  // texels
    static constexpr vk::Format format = vk::Format::eD16Unorm;

    explicit ShadowMap(const Device& device);

    vk::RenderPass pass() const { return *pass_; }
    /// For sampling with comparison.
    vk::DescriptorImageInfo descriptor() const;

    /// Draw the shadow casters between `begin` and `end`.
    void begin(const vk::raii::CommandBuffer& commands) const;
    void end(const vk::raii::CommandBuffer& commands) const;

private:
    DeviceImage depth_;
    vk::raii::RenderPass pass_{nullptr};
    vk::raii::Framebuffer framebuffer_{nullptr};
    vk::raii::Sampler sampler_{nullptr};
};

}  // namespace pliant::vulkan
