// A device image with its memory and one view of the whole image.
#pragma once

#include "backend/vulkan/device.hpp"

namespace pliant::vulkan {

struct DeviceImage {
    vk::raii::Image handle{nullptr};
    vk::raii::DeviceMemory memory{nullptr};
    vk::raii::ImageView view{nullptr};
};

inline DeviceImage make_image(const Device& device, vk::Extent2D size, vk::Format format,
                              vk::ImageUsageFlags usage, vk::ImageAspectFlags aspect,
                              vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1)
{
    DeviceImage image;
    image.handle = {device.handle(),
                    vk::ImageCreateInfo({}, vk::ImageType::e2D, format, {size.width, size.height, 1}, 1, 1,
                                        samples, vk::ImageTiling::eOptimal, usage)};
    const auto needs = image.handle.getMemoryRequirements();
    const auto type = device.memory_type(needs.memoryTypeBits, {}, vk::MemoryPropertyFlagBits::eDeviceLocal);
    image.memory = {device.handle(), vk::MemoryAllocateInfo(needs.size, type)};
    image.handle.bindMemory(*image.memory, 0);
    image.view = {device.handle(), vk::ImageViewCreateInfo({}, *image.handle, vk::ImageViewType::e2D, format,
                                                           {}, {aspect, 0, 1, 0, 1})};
    return image;
}

}  // namespace pliant::vulkan
