// Pictures that are seen: the images of a window's swapchain.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "pliant/render.hpp"
#include "render/picture_pass.hpp"

namespace pliant::vulkan {

class WindowTarget {
public:
    /// Of a surface that must outlive it. Has no images before `resize`. Throws Error(device_failure) when
    /// the device cannot draw to the surface.
    WindowTarget(const Device& device, vk::SurfaceKHR surface);

    PicturePassHandles passes() const { return passes_.handles(); }

    /// Makes images of the surface's size, or of this one where the surface leaves it open. No picture may be
    /// on its way. Without an area (a minimised window) there are no images.
    void resize(const Device& device, vk::Extent2D wanted);
    /// Gives the images back; to be called before the surface goes.
    void clear();
    /// When the surface is lost: `renew` lets it go and returns another of the same window.
    template <class Renew>
    void replace_surface(Renew&& renew)
    {
        clear();
        surface_ = renew();
    }
    bool has_images() const { return !images_.empty(); }
    vk::Extent2D size() const { return size_; }

    /// The next image to draw to, free when `free` is signalled; nothing when the images fit the surface no
    /// more.
    std::optional<std::uint32_t> acquire(vk::Semaphore free) const;
    /// Signalled by the commands that draw an image, waited for by `present`.
    vk::Semaphore drawn(std::uint32_t image) const { return *images_[image].drawn; }
    /// False when the images fit the surface no more.
    bool present(const Device& device, std::uint32_t image) const;

    PictureTarget target(std::uint32_t image) const { return buffers_->target(*images_[image].framebuffer); }
    /// Behind the drawing, in the same commands: the picture on its way to the host. False when the surface
    /// does not allow it.
    bool record_copy(const Device& device, const vk::raii::CommandBuffer& commands, std::uint32_t image);
    /// When those have run.
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
