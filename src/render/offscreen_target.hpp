// A picture that no one sees: drawn to an image of the device and copied to the host.
#pragma once

#include "pliant/render.hpp"
#include "render/picture_pass.hpp"

namespace pliant::vulkan {

class OffscreenTarget {
public:
    /// Throws Error(device_failure) when the device cannot draw a picture of this size.
    OffscreenTarget(const Device& device, vk::Extent2D size);

    const PictureFormat& format() const { return format_; }
    PictureTarget target() const { return buffers_.target(*framebuffer_); }
    /// The same for a part of the picture; the rest stays what it was.
    PictureTarget target(const vk::Rect2D& part) const { return buffers_.target(*framebuffer_, part); }

    /// Behind the drawing, in the same commands: the picture, or the part that was drawn, on its way to the
    /// host.
    void record_copy(const vk::raii::CommandBuffer& commands) const { record_copy(commands, {{}, size_}); }
    void record_copy(const vk::raii::CommandBuffer& commands, const vk::Rect2D& part) const;
    /// When those have run. Allocates only if `into` had another size.
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
