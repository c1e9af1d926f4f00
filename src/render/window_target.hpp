// Pictures in a window: the images of its swapchain.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "pliant/render.hpp"
#include "render/picture_pass.hpp"

namespace pliant::vulkan {

class WindowTarget {
public:
    /// `surface` must outlive it. Has no images before `resize`. Throws Error(device_failure) if the device
    /// cannot draw to the surface.
    WindowTarget(const Device& device, vk::SurfaceKHR surface);

    PicturePassHandles passes() const { return passes_.handles(); }

    /// Creates images of the surface's size, or of `wanted` if the surface leaves the size open. No picture
    /// may be in flight. A minimised window has no images.
    void resize(const Device& device, vk::Extent2D wanted);
    /// Destroys the images; call it before the surface is destroyed.
    void clear();
    /// After the surface is lost: `renew` destroys it and returns a new one of the same window.
    template <class Renew>
    void replace_surface(Renew&& renew)
    {
        clear();
        surface_ = renew();
    }
    bool has_images() const { return !images_.empty(); }
    vk::Extent2D size() const { return size_; }

    /// The next image to draw to, which is free once `free` is signalled; empty if the images no longer match
    /// the surface.
    std::optional<std::uint32_t> acquire(vk::Semaphore free) const;
    /// Signalled by the drawing commands of an image; `present` waits for it.
    vk::Semaphore drawn(std::uint32_t image) const { return *images_[image].drawn; }
    /// False if the images no longer match the surface.
    bool present(const Device& device, std::uint32_t image) const;

    PictureTarget target(std::uint32_t image) const { return buffers_->target(*images_[image].framebuffer); }
    /// Records, after the drawing commands, a copy of the picture to the host. False if the surface does not
    /// support it.
    bool record_copy(const Device& device, const vk::raii::CommandBuffer& commands, std::uint32_t image);
    /// Call it after those commands have run.
    void read(Image& into) const;

private:
    struct WindowImage {
        vk::Image handle;
        vk::raii::ImageView view{nullptr};
        vk::raii::Framebuffer framebuffer{nullptr};
        vk::raii::Semaphore drawn{nullptr};
    };
    vk::SurfaceKHR surface_;
    vk::SurfaceFormatKHR surface_format_;
    PictureFormat format_;
    PicturePasses passes_;
    vk::raii::SwapchainKHR swapchain_{nullptr};
    std::optional<PictureBuffers> buffers_;
    std::vector<WindowImage> images_;
    vk::Extent2D size_;
    bool can_copy_ = false;
    Buffer copy_;
};

}  // namespace pliant::vulkan
