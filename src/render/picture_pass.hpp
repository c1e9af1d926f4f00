// The two render passes that a picture is drawn in, and the images between them. The same for every target:
// what differs is the image that receives the finished picture (an off-screen image, or one of a window).
#pragma once

#include "backend/vulkan/device.hpp"
#include "render/device_image.hpp"

namespace pliant::vulkan {

/// Fixed for the life of a renderer; pipelines are made for it.
struct PictureFormat {
    vk::Format colour = vk::Format::eR8G8B8A8Srgb;  ///< an sRGB format: the shaders write linear light
    vk::ImageLayout final_layout = vk::ImageLayout::eTransferSrcOptimal;  ///< of the finished picture
    bool keeps = false;  ///< the picture begins in that layout, too, and stays where nothing is drawn
};

constexpr vk::Format depth_format = vk::Format::eD32Sfloat;

/// What pipelines are made for.
struct PicturePassHandles {
    vk::RenderPass surfaces;  ///< colour and depth of what is seen, one sample for each pixel
    vk::RenderPass
        picture;  ///< over it: smooth outlines, overlays, an interface; depth is only compared with
};

class PicturePasses {
public:
    /// Throws Error(device_failure) when the device cannot draw to these formats.
    PicturePasses(const Device& device, const PictureFormat& format);

    PicturePassHandles handles() const { return {*surfaces_, *picture_}; }

private:
    vk::raii::RenderPass surfaces_, picture_;
};

/// How pipelines bind the surfaces that were drawn: shaders/drawn.glsl.
vk::raii::DescriptorSetLayout make_drawn_layout(const Device& device);

/// Where to draw to.
struct PictureTarget {
    PicturePassHandles passes;
    vk::Framebuffer surfaces, picture;
    vk::DescriptorSet drawn;  ///< the surfaces, for the pass of the picture
    vk::Extent2D size;
    vk::Rect2D part{{}, size};  ///< what is drawn; less than the whole only where the format keeps the rest
};

/// The images behind a picture of one size: its surfaces' colour and depth.
class PictureBuffers {
public:
    PictureBuffers(const Device& device, const PictureFormat& format, PicturePassHandles passes,
                   vk::Extent2D size);

    /// A framebuffer of the second pass, that leaves its result in `picture`.
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
