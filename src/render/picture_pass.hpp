// The two render passes of a picture, and the images between them. Targets differ only in the image that
// receives the finished picture (an off-screen image or one of a window).
#pragma once

#include "backend/vulkan/device.hpp"
#include "render/device_image.hpp"

namespace pliant::vulkan {

/// Fixed for the life of a renderer: pipelines depend on it.
struct PictureFormat {
    vk::Format colour = vk::Format::eR8G8B8A8Srgb;  ///< an sRGB format: the shaders write linear values
    vk::ImageLayout final_layout = vk::ImageLayout::eTransferSrcOptimal;  ///< of the finished picture
    bool keeps = false;  ///< the previous picture is preserved where nothing is drawn; it begins in that
                         ///< layout
};

constexpr vk::Format depth_format = vk::Format::eD32Sfloat;

/// The render passes for which pipelines are made.
struct PicturePassHandles {
    vk::RenderPass surfaces;  ///< colour and depth of the visible surfaces, one sample per pixel
    vk::RenderPass
        picture;  ///< on top: smooth outlines, overlays, a user interface; tests depth without writing it
};

class PicturePasses {
public:
    /// Throws Error(device_failure) if the device cannot draw to these formats.
    PicturePasses(const Device& device, const PictureFormat& format);

    PicturePassHandles handles() const { return {*surfaces_, *picture_}; }

private:
    vk::raii::RenderPass surfaces_, picture_;
};

/// Descriptor set layout of the drawn surfaces: shaders/drawn.glsl.
vk::raii::DescriptorSetLayout make_drawn_layout(const Device& device);

/// The target of a picture.
struct PictureTarget {
    PicturePassHandles passes;
    vk::Framebuffer surfaces, picture;
    vk::DescriptorSet drawn;  ///< the surfaces, for the picture pass
    vk::Extent2D size;
    vk::Rect2D part{{}, size};  ///< the part to draw; smaller than the whole only if the format preserves the
                                ///< rest
};

/// The intermediate images for pictures of one size: colour and depth of surfaces.
class PictureBuffers {
public:
    PictureBuffers(const Device& device, const PictureFormat& format, PicturePassHandles passes,
                   vk::Extent2D size);

    /// A framebuffer of the second pass that writes to `picture`.
    vk::raii::Framebuffer make_framebuffer(const Device& device, vk::ImageView picture) const;
    PictureTarget target(vk::Framebuffer picture, const vk::Rect2D& part) const
    {
        return {passes_, *framebuffer_, picture, *drawn_, size_, part};
    }
    PictureTarget target(vk::Framebuffer picture) const { return target(picture, {{}, size_}); }

private:
    PicturePassHandles passes_;
    vk::Extent2D size_;
    DeviceImage colour_, depth_;
    vk::raii::Framebuffer framebuffer_{nullptr};
    vk::raii::Sampler sampler_{nullptr};
    vk::raii::DescriptorSetLayout layout_{nullptr};
    vk::raii::DescriptorPool pool_{nullptr};
    vk::raii::DescriptorSet drawn_{nullptr};
};

}  // namespace pliant::vulkan
