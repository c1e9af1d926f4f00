#include "render/picture_pass.hpp"

#include <array>

#include "pliant/error.hpp"

namespace pliant::vulkan {
namespace {

void require(const Device& device, vk::Format format, vk::FormatFeatureFlags features)
{
    if ((device.physical().getFormatProperties(format).optimalTilingFeatures & features) != features)
        throw Error(ErrorKind::device_failure, "the device " + device.info().name +
                                                   " cannot draw to the format " + vk::to_string(format) +
                                                   "; choose another with --device");
}

vk::AttachmentDescription attachment(vk::Format format, vk::AttachmentLoadOp load,
                                     vk::AttachmentStoreOp store, vk::ImageLayout first_layout,
                                     vk::ImageLayout final_layout)
{
    return {{},
            format,
            vk::SampleCountFlagBits::e1,
            load,
            store,
            vk::AttachmentLoadOp::eDontCare,  // stencil
            vk::AttachmentStoreOp::eDontCare,
            first_layout,
            final_layout};
}

vk::raii::RenderPass make_pass(const Device& device, const vk::AttachmentDescription& colour,
                               const vk::AttachmentDescription& depth, vk::ImageLayout depth_layout,
                               const std::array<vk::SubpassDependency, 2>& dependencies)
{
    const std::array attachments{colour, depth};
    const vk::AttachmentReference to_colour(0, vk::ImageLayout::eColorAttachmentOptimal),
        to_depth(1, depth_layout);
    const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, 0, nullptr, 1, &to_colour,
                                         nullptr, &to_depth);
    return {device.handle(), vk::RenderPassCreateInfo({}, attachments, subpass, dependencies)};
}

vk::raii::RenderPass make_surface_pass(const Device& device, const PictureFormat& format)
{
    using Load = vk::AttachmentLoadOp;
    using Store = vk::AttachmentStoreOp;
    using Layout = vk::ImageLayout;
    using Step = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    const auto depth_tests = Step::eEarlyFragmentTests | Step::eLateFragmentTests;
    require(device, format.colour,
            vk::FormatFeatureFlagBits::eColorAttachment | vk::FormatFeatureFlagBits::eColorAttachmentBlend |
                vk::FormatFeatureFlagBits::eSampledImage);
    require(device, depth_format,
            vk::FormatFeatureFlagBits::eDepthStencilAttachment | vk::FormatFeatureFlagBits::eSampledImage);
    // The backdrop covers all remaining pixels, so colours need no clear. Before: the previous picture has
    // finished reading colours and depth. After: the picture pass reads both.
    const auto written = Access::eColorAttachmentWrite | Access::eDepthStencilAttachmentWrite;
    return make_pass(
        device,
        attachment(format.colour, Load::eDontCare, Store::eStore, Layout::eUndefined,
                   Layout::eShaderReadOnlyOptimal),
        attachment(depth_format, Load::eClear, Store::eStore, Layout::eUndefined,
                   Layout::eDepthStencilReadOnlyOptimal),
        Layout::eDepthStencilAttachmentOptimal,
        {vk::SubpassDependency(
             VK_SUBPASS_EXTERNAL, 0, Step::eFragmentShader | Step::eColorAttachmentOutput | depth_tests,
             Step::eColorAttachmentOutput | depth_tests, Access::eDepthStencilAttachmentWrite,
             written | Access::eDepthStencilAttachmentRead),
         vk::SubpassDependency(0, VK_SUBPASS_EXTERNAL, Step::eColorAttachmentOutput | depth_tests,
                               Step::eFragmentShader | depth_tests, written,
                               Access::eShaderRead | Access::eDepthStencilAttachmentRead)});
}

vk::raii::RenderPass make_picture_pass(const Device& device, const PictureFormat& format)
{
    using Load = vk::AttachmentLoadOp;
    using Store = vk::AttachmentStoreOp;
    using Layout = vk::ImageLayout;
    using Step = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    // Before: the last picture has been copied or presented. After: this one may be copied.
    return make_pass(
        device,
        attachment(format.colour, Load::eDontCare, Store::eStore,
                   format.keeps ? format.final_layout : Layout::eUndefined, format.final_layout),
        attachment(depth_format, Load::eLoad, Store::eDontCare, Layout::eDepthStencilReadOnlyOptimal,
                   Layout::eDepthStencilReadOnlyOptimal),
        Layout::eDepthStencilReadOnlyOptimal,
        {vk::SubpassDependency(VK_SUBPASS_EXTERNAL, 0, Step::eColorAttachmentOutput | Step::eTransfer,
                               Step::eColorAttachmentOutput, Access::eColorAttachmentWrite,
                               Access::eColorAttachmentRead | Access::eColorAttachmentWrite),
         vk::SubpassDependency(0, VK_SUBPASS_EXTERNAL, Step::eColorAttachmentOutput, Step::eTransfer,
                               Access::eColorAttachmentWrite, Access::eTransferRead)});
}

}  // namespace

PicturePasses::PicturePasses(const Device& device, const PictureFormat& format)
    : surfaces_(make_surface_pass(device, format)), picture_(make_picture_pass(device, format))
{
}

vk::raii::DescriptorSetLayout make_drawn_layout(const Device& device)
{
    using Kind = vk::DescriptorType;
    const vk::DescriptorSetLayoutBinding colour_and_depth[] = {
        {0, Kind::eCombinedImageSampler, 1, vk::ShaderStageFlagBits::eFragment},
        {1, Kind::eCombinedImageSampler, 1, vk::ShaderStageFlagBits::eFragment}};
    return {device.handle(), vk::DescriptorSetLayoutCreateInfo({}, colour_and_depth)};
}

PictureBuffers::PictureBuffers(const Device& device, const PictureFormat& format, PicturePassHandles passes,
                               vk::Extent2D size)
    : passes_(passes),
      size_(size),
      colour_(make_image(device, size, format.colour,
                         vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled,
                         vk::ImageAspectFlagBits::eColor)),
      depth_(make_image(device, size, depth_format,
                        vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled,
                        vk::ImageAspectFlagBits::eDepth)),
      sampler_(device.handle(), vk::SamplerCreateInfo{}),
      layout_(make_drawn_layout(device))
{
    const std::array views{*colour_.view, *depth_.view};
    framebuffer_ = {device.handle(),
                    vk::FramebufferCreateInfo({}, passes.surfaces, views, size.width, size.height, 1)};
    const vk::DescriptorPoolSize two(vk::DescriptorType::eCombinedImageSampler, 2);
    pool_ = {device.handle(), {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, two}};
    const vk::DescriptorSetLayout layout = *layout_;
    drawn_ = std::move(vk::raii::DescriptorSets(device.handle(), {*pool_, layout}).front());
    using Layout = vk::ImageLayout;
    const vk::DescriptorImageInfo images[] = {
        {*sampler_, *colour_.view, Layout::eShaderReadOnlyOptimal},
        {*sampler_, *depth_.view, Layout::eDepthStencilReadOnlyOptimal}};
    device.handle().updateDescriptorSets(
        {vk::WriteDescriptorSet(*drawn_, 0, 0, vk::DescriptorType::eCombinedImageSampler, images[0]),
         vk::WriteDescriptorSet(*drawn_, 1, 0, vk::DescriptorType::eCombinedImageSampler, images[1])},
        {});
}

vk::raii::Framebuffer PictureBuffers::make_framebuffer(const Device& device, vk::ImageView picture) const
{
    const std::array views{picture, *depth_.view};
    return {device.handle(),
            vk::FramebufferCreateInfo({}, passes_.picture, views, size_.width, size_.height, 1)};
}

}  // namespace pliant::vulkan
