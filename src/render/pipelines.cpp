#include "render/pipelines.hpp"

#include <array>
#include <span>

#include "render/shapes.hpp"

namespace pliant::vulkan {
namespace {

static_assert(sizeof(ShapePlacement) == push_constant_bytes &&
              sizeof(GroundPlacement) <= push_constant_bytes);

// SPIR-V as the build makes it from shaders/.
constexpr std::uint32_t backdrop_frag[] = {
#include "shaders/backdrop.frag.inc"
};
constexpr std::uint32_t backdrop_vert[] = {
#include "shaders/backdrop.vert.inc"
};
constexpr std::uint32_t cloth_frag[] = {
#include "shaders/cloth.frag.inc"
};
constexpr std::uint32_t cloth_vert[] = {
#include "shaders/cloth.vert.inc"
};
constexpr std::uint32_t cloth_shadow_vert[] = {
#include "shaders/cloth_shadow.vert.inc"
};
constexpr std::uint32_t ground_frag[] = {
#include "shaders/ground.frag.inc"
};
constexpr std::uint32_t ground_vert[] = {
#include "shaders/ground.vert.inc"
};
constexpr std::uint32_t legend_frag[] = {
#include "shaders/legend.frag.inc"
};
constexpr std::uint32_t legend_vert[] = {
#include "shaders/legend.vert.inc"
};
constexpr std::uint32_t shape_frag[] = {
#include "shaders/shape.frag.inc"
};
constexpr std::uint32_t shape_vert[] = {
#include "shaders/shape.vert.inc"
};
constexpr std::uint32_t shape_shadow_vert[] = {
#include "shaders/shape_shadow.vert.inc"
};

using Code = std::span<const std::uint32_t>;

/// What is particular about a pipeline.
struct Recipe {
    Code vertex;
    Code fragment = {};  ///< without, only depth is drawn
    vk::PrimitiveTopology topology = vk::PrimitiveTopology::eTriangleList;
    bool shape_vertices = false;  ///< ShapeVertex in, else the shader pulls or makes its vertices
    bool one_sided = false;
    bool behind_everything = false;  ///< covers only pixels that nothing has covered
    bool over_everything = false;
    bool show_strain = false;
};

/// What the pipelines of a pass have in common.
struct Pass {
    vk::RenderPass pass;
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
    bool casts_shadows = false;
};

vk::raii::Pipeline make_pipeline(const Device& device, vk::PipelineLayout layout, const Pass& pass,
                                 const Recipe& recipe)
{
    using Stage = vk::ShaderStageFlagBits;
    const VkBool32 show_strain = recipe.show_strain;
    const vk::SpecializationMapEntry entry(0, 0, sizeof show_strain);
    const vk::SpecializationInfo constants(1, &entry, sizeof show_strain, &show_strain);
    const auto vertex = device.make_shader(recipe.vertex);
    vk::raii::ShaderModule fragment{nullptr};
    std::vector<vk::PipelineShaderStageCreateInfo> stages{{{}, Stage::eVertex, *vertex, "main"}};
    if (!recipe.fragment.empty()) {
        fragment = device.make_shader(recipe.fragment);
        stages.push_back({{}, Stage::eFragment, *fragment, "main", &constants});
    }

    const vk::VertexInputBindingDescription binding(0, sizeof(ShapeVertex));
    const std::array<vk::VertexInputAttributeDescription, 2> attributes{
        vk::VertexInputAttributeDescription(0, 0, vk::Format::eR32G32B32A32Sfloat, 0),
        vk::VertexInputAttributeDescription(1, 0, vk::Format::eR32G32B32Sfloat,
                                            offsetof(ShapeVertex, normal))};
    vk::PipelineVertexInputStateCreateInfo input;
    if (recipe.shape_vertices) {
        input.setVertexBindingDescriptions(binding).setVertexAttributeDescriptions(attributes);
        if (pass.casts_shadows) input.vertexAttributeDescriptionCount = 1;  // shadows need no normals
    }

    const vk::PipelineInputAssemblyStateCreateInfo assembly({}, recipe.topology);
    const vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
    vk::PipelineRasterizationStateCreateInfo raster;
    raster.cullMode = recipe.one_sided ? vk::CullModeFlagBits::eBack : vk::CullModeFlagBits::eNone;
    // The shadow map's y runs upwards, and so mirrors the turning of a triangle.
    raster.frontFace = pass.casts_shadows ? vk::FrontFace::eClockwise : vk::FrontFace::eCounterClockwise;
    raster.lineWidth = 1;
    if (pass.casts_shadows) {
        // A surface seen edge-on by the sun spans much depth in one texel.
        raster.depthBiasEnable = VK_TRUE;
        raster.depthBiasConstantFactor = 2.0f;
        raster.depthBiasSlopeFactor = 2.0f;
    }
    const vk::PipelineMultisampleStateCreateInfo multisample({}, pass.samples);
    const bool far = recipe.behind_everything, free = recipe.over_everything;
    const vk::PipelineDepthStencilStateCreateInfo depth(
        {}, !free, !far && !free, far ? vk::CompareOp::eLessOrEqual : vk::CompareOp::eLess);
    using Channel = vk::ColorComponentFlagBits;
    vk::PipelineColorBlendAttachmentState blend;
    blend.colorWriteMask = Channel::eR | Channel::eG | Channel::eB | Channel::eA;
    vk::PipelineColorBlendStateCreateInfo blending;
    if (!pass.casts_shadows) blending.setAttachments(blend);
    const std::array<vk::DynamicState, 2> changing{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamic({}, changing);

    return {device.handle(), nullptr,
            vk::GraphicsPipelineCreateInfo({}, stages, &input, &assembly, nullptr, &viewport, &raster,
                                           &multisample, &depth, &blending, &dynamic, layout, pass.pass, 0)};
}

vk::raii::DescriptorSetLayout make_frame_set(const Device& device)
{
    using Stage = vk::ShaderStageFlagBits;
    const vk::DescriptorSetLayoutBinding bindings[] = {
        {0, vk::DescriptorType::eUniformBuffer, 1, Stage::eVertex | Stage::eFragment},
        {1, vk::DescriptorType::eCombinedImageSampler, 1, Stage::eFragment}};
    return {device.handle(), vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::DescriptorSetLayout make_cloth_set(const Device& device)
{
    std::array<vk::DescriptorSetLayoutBinding, 4> bindings;
    for (std::uint32_t i = 0; i < bindings.size(); ++i)
        bindings[i] = {i, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eVertex};
    return {device.handle(), vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::PipelineLayout make_layout(const Device& device, vk::DescriptorSetLayout frame,
                                     vk::DescriptorSetLayout cloth)
{
    const vk::DescriptorSetLayout sets[] = {frame, cloth};
    const vk::PushConstantRange constants(
        vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0, push_constant_bytes);
    return {device.handle(), vk::PipelineLayoutCreateInfo({}, sets, constants)};
}

}  // namespace

Pipelines::Pipelines(const Device& device, const PictureTarget& target, vk::RenderPass shadow_pass,
                     ClothColour colour)
    : frame_set(make_frame_set(device)),
      cloth_set(make_cloth_set(device)),
      layout(make_layout(device, *frame_set, *cloth_set)),
      cloth_shadow(nullptr),
      shape_shadow(nullptr),
      cloth(nullptr),
      shape(nullptr),
      ground(nullptr),
      backdrop(nullptr)
{
    const auto strip = vk::PrimitiveTopology::eTriangleStrip;
    const bool strain = colour == ClothColour::strain;
    const Pass shadow{.pass = shadow_pass, .casts_shadows = true};
    const Pass picture{.pass = target.pass, .samples = target.samples};
    const auto make = [&](const Pass& pass, const Recipe& recipe) {
        return make_pipeline(device, *layout, pass, recipe);
    };
    cloth_shadow = make(shadow, {.vertex = cloth_shadow_vert});
    shape_shadow = make(shadow, {.vertex = shape_shadow_vert, .shape_vertices = true, .one_sided = true});
    cloth = make(picture, {.vertex = cloth_vert, .fragment = cloth_frag, .show_strain = strain});
    shape = make(picture,
                 {.vertex = shape_vert, .fragment = shape_frag, .shape_vertices = true, .one_sided = true});
    ground =
        make(picture, {.vertex = ground_vert, .fragment = ground_frag, .topology = strip, .one_sided = true});
    backdrop = make(picture, {.vertex = backdrop_vert, .fragment = backdrop_frag, .behind_everything = true});
    if (strain)
        legend = make(
            picture,
            {.vertex = legend_vert, .fragment = legend_frag, .topology = strip, .over_everything = true});
}

}  // namespace pliant::vulkan
