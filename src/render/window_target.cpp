#include "render/window_target.hpp"

#include <algorithm>
#include <cstring>

#include "pliant/error.hpp"

namespace pliant::vulkan {
namespace {

/// An 8-bit sRGB format: the shaders write linear values.
vk::SurfaceFormatKHR surface_format(const Device& device, vk::SurfaceKHR surface)
{
    if (!device.physical().getSurfaceSupportKHR(device.queue_family(), surface))
        throw Error(ErrorKind::device_failure, "the device " + device.info().name +
                                                   " cannot show pictures in this window; choose another "
                                                   "with --device, or use --headless");
    const auto formats = device.physical().getSurfaceFormatsKHR(surface);
    for (const auto wanted : {vk::Format::eB8G8R8A8Srgb, vk::Format::eR8G8B8A8Srgb})
        for (const auto& format : formats)
            if (format.format == wanted) return format;
    throw Error(ErrorKind::device_failure, "the window has no sRGB format on the device " +
                                               device.info().name +
                                               "; choose another with --device, or use --headless");
}

std::uint32_t clamped(std::uint32_t a, std::uint32_t least, std::uint32_t most)
{
    return std::max(least, std::min(a, most));
}

}  // namespace

WindowTarget::WindowTarget(const Device& device, vk::SurfaceKHR surface)
    : surface_(surface),
      surface_format_(surface_format(device, surface)),
      format_{surface_format_.format, vk::ImageLayout::ePresentSrcKHR},
      passes_(device, format_)
{
}

void WindowTarget::clear()
{
    images_.clear();
    buffers_.reset();
    swapchain_ = nullptr;
}

void WindowTarget::resize(const Device& device, vk::Extent2D wanted)
{
    const auto can = device.physical().getSurfaceCapabilitiesKHR(surface_);
    const bool open = can.currentExtent.width == ~0u;
    size_ = open ? vk::Extent2D{clamped(wanted.width, can.minImageExtent.width, can.maxImageExtent.width),
                                clamped(wanted.height, can.minImageExtent.height, can.maxImageExtent.height)}
                 : can.currentExtent;
    images_.clear();
    buffers_.reset();
    copy_ = {};
    if (size_.width == 0 || size_.height == 0) {
        swapchain_ = nullptr;
        return;
    }
    using ImageUsage = vk::ImageUsageFlagBits;
    can_copy_ = static_cast<bool>(can.supportedUsageFlags & ImageUsage::eTransferSrc);
    const std::uint32_t count =
        can.maxImageCount > 0 ? std::min(can.minImageCount + 1, can.maxImageCount) : can.minImageCount + 1;
    vk::SwapchainCreateInfoKHR info({}, surface_, count, surface_format_.format, surface_format_.colorSpace,
                                    size_, 1, ImageUsage::eColorAttachment);
    if (can_copy_) info.imageUsage |= ImageUsage::eTransferSrc;
    info.preTransform = can.currentTransform;
    info.compositeAlpha = can.supportedCompositeAlpha & vk::CompositeAlphaFlagBitsKHR::eOpaque
                              ? vk::CompositeAlphaFlagBitsKHR::eOpaque
                              : vk::CompositeAlphaFlagBitsKHR::eInherit;
    info.presentMode = vk::PresentModeKHR::eFifo;  // the one mode that always exists
    info.clipped = VK_TRUE;
    info.oldSwapchain = *swapchain_;
    swapchain_ = vk::raii::SwapchainKHR(device.handle(), info);
    buffers_.emplace(device, format_, passes_.handles(), size_);
    for (const vk::Image handle : swapchain_.getImages()) {
        WindowImage image;
        image.handle = handle;
        image.view = {device.handle(),
                      vk::ImageViewCreateInfo({}, handle, vk::ImageViewType::e2D, format_.colour, {},
                                              {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1})};
        image.framebuffer = buffers_->make_framebuffer(device, *image.view);
        image.drawn = {device.handle(), vk::SemaphoreCreateInfo{}};
        images_.push_back(std::move(image));
    }
}

std::optional<std::uint32_t> WindowTarget::acquire(vk::Semaphore free) const
{
    if (!has_images()) return std::nullopt;
    try {
        const auto [result, image] = swapchain_.acquireNextImage(UINT64_MAX, free);
        return image;  // "suboptimal" is still presented
    } catch (const vk::OutOfDateKHRError&) {
        return std::nullopt;
    }
}

bool WindowTarget::present(const Device& device, std::uint32_t image) const
{
    const vk::Semaphore wait = *images_[image].drawn;
    const vk::SwapchainKHR swapchain = *swapchain_;
    try {
        return device.present(vk::PresentInfoKHR(wait, swapchain, image)) == vk::Result::eSuccess;
    } catch (const vk::OutOfDateKHRError&) {
        return false;
    }
}

bool WindowTarget::record_copy(const Device& device, const vk::raii::CommandBuffer& commands,
                               std::uint32_t image)
{
    if (!can_copy_) return false;
    if (copy_.size == 0)
        copy_ = device.make_buffer(vk::DeviceSize{4} * size_.width * size_.height,
                                   vk::BufferUsageFlagBits::eTransferDst, Memory::readback, "picture");
    using Layout = vk::ImageLayout;
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    const auto turn = [&](Layout from, Layout to, Access written, Access read) {
        commands.pipelineBarrier(
            Stage::eColorAttachmentOutput | Stage::eTransfer, Stage::eTransfer, {}, {}, {},
            vk::ImageMemoryBarrier(written, read, from, to, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
                                   images_[image].handle, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}));
    };
    turn(format_.final_layout, Layout::eTransferSrcOptimal, Access::eColorAttachmentWrite,
         Access::eTransferRead);
    commands.copyImageToBuffer(images_[image].handle, Layout::eTransferSrcOptimal, *copy_,
                               vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {},
                                                   {size_.width, size_.height, 1}));
    turn(Layout::eTransferSrcOptimal, format_.final_layout, Access::eTransferRead, Access::eTransferRead);
    barrier(commands, Stage::eTransfer, Access::eTransferWrite, Stage::eHost, Access::eHostRead);
    return true;
}

void WindowTarget::read(Image& into) const
{
    into.width = size_.width;
    into.height = size_.height;
    into.rgba.resize(std::size_t{4} * size_.width * size_.height);
    std::memcpy(into.rgba.data(), copy_.mapped, into.rgba.size());
    if (format_.colour != vk::Format::eB8G8R8A8Srgb) return;
    for (std::size_t i = 0; i < into.rgba.size(); i += 4) std::swap(into.rgba[i], into.rgba[i + 2]);
}

}  // namespace pliant::vulkan
