// Off-screen pictures: drawn to a device image and copied to the host.
#pragma once

#include "pliant/render.hpp"
#include "render/picture_pass.hpp"

namespace pliant::vulkan {

class OffscreenTarget {
public:
    /// Throws Error(device_failure) if the device cannot draw a picture of this size.
    OffscreenTarget(const Device& device, vk::Extent2D size);

    const PictureFormat& format() const { return format_; }
    PictureTarget target() const { return buffers_.target(*framebuffer_); }
    /// The same for a part of the picture; the rest is unchanged.
    PictureTarget target(const vk::Rect2D& part) const { return buffers_.target(*framebuffer_, part); }

    /// Records, after the drawing commands, a copy of the picture, or of the part that was drawn, to the
    /// host.
    void record_copy(const vk::raii::CommandBuffer& commands) const { record_copy(commands, {{}, size_}); }
    void record_copy(const vk::raii::CommandBuffer& commands, const vk::Rect2D& part) const;
    /// Call it after those commands have run. Allocates only if `into` had another size.
    void read(Image& into) const;

private:
    vk::Extent2D size_;
    PictureFormat format_;
    PicturePasses passes_;
    DeviceImage picture_;
    PictureBuffers buffers_;
    vk::raii::Framebuffer framebuffer_;
    Buffer copy_;
};

}  // namespace pliant::vulkan
