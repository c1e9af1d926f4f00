#include "render/offscreen_target.hpp"

#include <cstring>

#include "pliant/error.hpp"

namespace pliant::vulkan {
namespace {

vk::Extent2D checked(const Device& device, vk::Extent2D size)
{
    const auto limits = device.physical().getProperties().limits;
    const auto most =
        std::min({limits.maxImageDimension2D, limits.maxFramebufferWidth, limits.maxFramebufferHeight});
    if (size.width == 0 || size.height == 0 || size.width > most || size.height > most)
        throw Error(ErrorKind::device_failure,
                    "a picture of " + std::to_string(size.width) + " x " + std::to_string(size.height) +
                        " pixels cannot be drawn on " + device.info().name + ": each side must be 1 to " +
                        std::to_string(most) + " pixels");
    return size;
}

}  // namespace

OffscreenTarget::OffscreenTarget(const Device& device, vk::Extent2D size)
    : size_(checked(device, size)),
      format_{.keeps = true},
      passes_(device, format_),
      picture_(make_image(device, size, format_.colour,
                          vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc,
                          vk::ImageAspectFlagBits::eColor)),
      buffers_(device, format_, passes_.handles(), size),
      framebuffer_(buffers_.make_framebuffer(device, *picture_.view)),
      copy_(device.make_buffer(vk::DeviceSize{4} * size.width * size.height,
                               vk::BufferUsageFlagBits::eTransferDst, Memory::readback, "picture"))
{
    const vk::raii::CommandBuffer commands = device.make_commands();
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    commands.pipelineBarrier(
        vk::PipelineStageFlagBits::eTopOfPipe, vk::PipelineStageFlagBits::eBottomOfPipe, {}, {}, {},
        vk::ImageMemoryBarrier({}, {}, vk::ImageLayout::eUndefined, format_.final_layout,
                               VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, *picture_.handle,
                               {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}));
    commands.end();
    device.run(commands);
}

void OffscreenTarget::record_copy(const vk::raii::CommandBuffer& commands, const vk::Rect2D& part) const
{
    // The render pass has changed the picture to the layout for copying, and ordered its writes before the
    // copy.
    const auto x = static_cast<std::uint32_t>(part.offset.x), y = static_cast<std::uint32_t>(part.offset.y);
    commands.copyImageToBuffer(
        *picture_.handle, format_.final_layout, *copy_,
        vk::BufferImageCopy(vk::DeviceSize{4} * (vk::DeviceSize{y} * size_.width + x), size_.width,
                            size_.height, {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                            {part.offset.x, part.offset.y, 0}, {part.extent.width, part.extent.height, 1}));
    barrier(commands, vk::PipelineStageFlagBits::eTransfer, vk::AccessFlagBits::eTransferWrite,
            vk::PipelineStageFlagBits::eHost, vk::AccessFlagBits::eHostRead);
}

void OffscreenTarget::read(Image& into) const
{
    into.width = size_.width;
    into.height = size_.height;
    into.rgba.resize(std::size_t{4} * size_.width * size_.height);
    std::memcpy(into.rgba.data(), copy_.mapped, into.rgba.size());
}

}  // namespace pliant::vulkan
