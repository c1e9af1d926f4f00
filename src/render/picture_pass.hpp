// The render pass that a picture is drawn in, and the images it draws to. The same for every target: what
// differs is the image that receives the finished picture (an off-screen image, or one of a window).
#pragma once

#include "backend/vulkan/device.hpp"
#include "render/device_image.hpp"

namespace pliant::vulkan {

/// Fixed for the life of a renderer; pipelines are made for it.
struct PictureFormat {
    vk::Format colour = vk::Format::eR8G8B8A8Srgb;  ///< an sRGB format: the shaders write linear light
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e4;
    vk::ImageLayout final_layout = vk::ImageLayout::eTransferSrcOptimal;  ///< of the finished picture
    bool keeps = false;  ///< the picture begins in that layout, too, and stays where nothing is drawn
};

constexpr vk::Format depth_format = vk::Format::eD32Sfloat;

/// 4 samples where the device has them, else 1.
vk::SampleCountFlagBits best_samples(const Device& device);

/// Throws Error(device_failure) when the device cannot draw to these formats.
vk::raii::RenderPass make_picture_pass(const Device& device, const PictureFormat& format);

/// The images behind a picture of one size: samples and depth. With one sample the picture itself is drawn
/// to.
class PictureBuffers {
public:
    PictureBuffers(const Device& device, const PictureFormat& format, vk::RenderPass pass, vk::Extent2D size);

    /// A framebuffer that leaves its result in `picture`.
    vk::raii::Framebuffer make_framebuffer(const Device& device, vk::ImageView picture) const;

private:
    vk::RenderPass pass_;
    vk::Extent2D size_;
    DeviceImage samples_, depth_;
};

/// Where to draw to.
struct PictureTarget {
    vk::RenderPass pass;
    vk::Framebuffer framebuffer;
    vk::Extent2D size;
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
    vk::Rect2D part{{}, size};  ///< what is drawn; less than the whole only where the format keeps the rest
};

}  // namespace pliant::vulkan
