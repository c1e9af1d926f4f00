#include "render/shadow_map.hpp"

namespace pliant::vulkan {
namespace {

vk::raii::RenderPass make_pass(const Device& device)
{
    using Layout = vk::ImageLayout;
    const vk::AttachmentDescription depth({}, ShadowMap::format, vk::SampleCountFlagBits::e1,
                                          vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
                                          vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eDontCare,
                                          Layout::eUndefined, Layout::eDepthStencilReadOnlyOptimal);
    const vk::AttachmentReference reference(0, Layout::eDepthStencilAttachmentOptimal);
    const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, 0, nullptr, 0, nullptr,
                                         nullptr, &reference);
    // Before: the last frame has finished sampling. After: fragments may sample.
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    const auto tests = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
    const vk::SubpassDependency dependencies[] = {
        {VK_SUBPASS_EXTERNAL, 0, Stage::eFragmentShader | tests, tests, Access::eDepthStencilAttachmentWrite,
         Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite},
        {0, VK_SUBPASS_EXTERNAL, tests, Stage::eFragmentShader, Access::eDepthStencilAttachmentWrite,
         Access::eShaderRead}};
    return {device.handle(), vk::RenderPassCreateInfo({}, depth, subpass, dependencies)};
}

/// Compares up to four texels at once if the device can. Everything outside the map is lit.
vk::raii::Sampler make_sampler(const Device& device)
{
    const bool linear =
        static_cast<bool>(device.physical().getFormatProperties(ShadowMap::format).optimalTilingFeatures &
                          vk::FormatFeatureFlagBits::eSampledImageFilterLinear);
    const auto filter = linear ? vk::Filter::eLinear : vk::Filter::eNearest;
    const auto beyond = vk::SamplerAddressMode::eClampToBorder;
    return {device.handle(),
            vk::SamplerCreateInfo({}, filter, filter, vk::SamplerMipmapMode::eNearest, beyond, beyond, beyond,
                                  0, VK_FALSE, 1, VK_TRUE, vk::CompareOp::eLessOrEqual, 0, 0,
                                  vk::BorderColor::eFloatOpaqueWhite)};
}

}  // namespace

ShadowMap::ShadowMap(const Device& device)
    : depth_(make_image(device, {edge, edge}, format,
                        vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled,
                        vk::ImageAspectFlagBits::eDepth)),
      pass_(make_pass(device)),
      framebuffer_(device.handle(), vk::FramebufferCreateInfo({}, *pass_, *depth_.view, edge, edge, 1)),
      sampler_(make_sampler(device))
{
}

vk::DescriptorImageInfo ShadowMap::descriptor() const
{
    return {*sampler_, *depth_.view, vk::ImageLayout::eDepthStencilReadOnlyOptimal};
}

void ShadowMap::begin(const vk::raii::CommandBuffer& commands) const
{
    const vk::Rect2D area({}, {edge, edge});
    const vk::ClearValue far(vk::ClearDepthStencilValue(1.0f, 0));
    commands.beginRenderPass(vk::RenderPassBeginInfo(*pass_, *framebuffer_, area, far),
                             vk::SubpassContents::eInline);
    commands.setViewport(0, vk::Viewport(0, 0, edge, edge, 0, 1));
    commands.setScissor(0, area);
}

void ShadowMap::end(const vk::raii::CommandBuffer& commands) const { commands.endRenderPass(); }

}  // namespace pliant::vulkan
