#include "render/picture_pass.hpp"

#include <vector>

#include "pliant/error.hpp"

namespace pliant::vulkan {
namespace {

bool many(vk::SampleCountFlagBits samples) { return samples != vk::SampleCountFlagBits::e1; }

void require(const Device& device, vk::Format format, vk::FormatFeatureFlags features)
{
    if ((device.physical().getFormatProperties(format).optimalTilingFeatures & features) != features)
        throw Error(ErrorKind::device_failure, "the device " + device.info().name +
                                                   " cannot draw to the format " + vk::to_string(format) +
                                                   "; choose another with --device");
}

}  // namespace

vk::SampleCountFlagBits best_samples(const Device& device)
{
    const auto limits = device.physical().getProperties().limits;
    const auto both = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
    return both & vk::SampleCountFlagBits::e4 ? vk::SampleCountFlagBits::e4 : vk::SampleCountFlagBits::e1;
}

vk::raii::RenderPass make_picture_pass(const Device& device, const PictureFormat& format)
{
    require(device, format.colour, vk::FormatFeatureFlagBits::eColorAttachment);
    require(device, depth_format, vk::FormatFeatureFlagBits::eDepthStencilAttachment);

    using Load = vk::AttachmentLoadOp;
    using Store = vk::AttachmentStoreOp;
    using Layout = vk::ImageLayout;
    const bool resolve = many(format.samples);
    const auto attachment = [](vk::Format kind, vk::SampleCountFlagBits samples, Load load, Store store,
                               Layout final_layout, Layout first_layout = Layout::eUndefined) {
        return vk::AttachmentDescription({}, kind, samples, load, store, Load::eDontCare, Store::eDontCare,
                                         first_layout, final_layout);
    };
    const Layout first_layout = format.keeps ? format.final_layout : Layout::eUndefined;  // of the picture
    // The backdrop covers every pixel that nothing else does: colours need no clearing.
    std::vector<vk::AttachmentDescription> attachments{
        attachment(format.colour, format.samples, Load::eDontCare, resolve ? Store::eDontCare : Store::eStore,
                   resolve ? Layout::eColorAttachmentOptimal : format.final_layout,
                   resolve ? Layout::eUndefined : first_layout),
        attachment(depth_format, format.samples, Load::eClear, Store::eDontCare,
                   Layout::eDepthStencilAttachmentOptimal)};
    if (resolve)
        attachments.push_back(attachment(format.colour, vk::SampleCountFlagBits::e1, Load::eDontCare,
                                         Store::eStore, format.final_layout, first_layout));

    const vk::AttachmentReference colour(0, Layout::eColorAttachmentOptimal);
    const vk::AttachmentReference depth(1, Layout::eDepthStencilAttachmentOptimal);
    const vk::AttachmentReference picture(2, Layout::eColorAttachmentOptimal);
    const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, 0, nullptr, 1, &colour,
                                         resolve ? &picture : nullptr, &depth);

    // Before: the last picture has been copied or shown, and its depth is no longer read. After:
    // it may be copied.
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    const auto drawing =
        Stage::eColorAttachmentOutput | Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
    const auto drawn = Access::eColorAttachmentWrite | Access::eDepthStencilAttachmentWrite;
    const vk::SubpassDependency dependencies[] = {
        {VK_SUBPASS_EXTERNAL, 0, drawing | Stage::eTransfer, drawing, drawn,
         drawn | Access::eColorAttachmentRead | Access::eDepthStencilAttachmentRead},
        {0, VK_SUBPASS_EXTERNAL, Stage::eColorAttachmentOutput, Stage::eTransfer,
         Access::eColorAttachmentWrite, Access::eTransferRead}};
    return {device.handle(), vk::RenderPassCreateInfo({}, attachments, subpass, dependencies)};
}

PictureBuffers::PictureBuffers(const Device& device, const PictureFormat& format, vk::RenderPass pass,
                               vk::Extent2D size)
    : pass_(pass), size_(size)
{
    using Usage = vk::ImageUsageFlagBits;
    if (many(format.samples))
        samples_ =
            make_image(device, size, format.colour, Usage::eColorAttachment | Usage::eTransientAttachment,
                       vk::ImageAspectFlagBits::eColor, format.samples);
    depth_ =
        make_image(device, size, depth_format, Usage::eDepthStencilAttachment | Usage::eTransientAttachment,
                   vk::ImageAspectFlagBits::eDepth, format.samples);
}

vk::raii::Framebuffer PictureBuffers::make_framebuffer(const Device& device, vk::ImageView picture) const
{
    std::vector<vk::ImageView> views{picture, *depth_.view};
    if (*samples_.view) views = {*samples_.view, *depth_.view, picture};
    return {device.handle(), vk::FramebufferCreateInfo({}, pass_, views, size_.width, size_.height, 1)};
}

}  // namespace pliant::vulkan
