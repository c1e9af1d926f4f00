#include "render/pipelines.hpp"

#include <array>
#include <span>

#include "backend/vulkan/device_limits.hpp"
#include "pliant/error.hpp"
#include "render/legend.hpp"

namespace pliant::vulkan {
namespace {

static_assert(sizeof(ShapePlacement) == push_constant_bytes &&
              sizeof(GroundPlacement) <= push_constant_bytes && sizeof(LegendText) <= push_constant_bytes);

// SPIR-V that the build compiles from shaders/.
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
constexpr std::uint32_t cloth_outline_vert[] = {
#include "shaders/cloth_outline.vert.inc"
};
constexpr std::uint32_t cloth_shadow_vert[] = {
#include "shaders/cloth_shadow.vert.inc"
};
constexpr std::uint32_t cloth_surface_comp[] = {
#include "shaders/cloth_surface.comp.inc"
};
constexpr std::uint32_t drawn_frag[] = {
#include "shaders/drawn.frag.inc"
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
constexpr std::uint32_t line_frag[] = {
#include "shaders/line.frag.inc"
};
constexpr std::uint32_t line_vert[] = {
#include "shaders/line.vert.inc"
};
constexpr std::uint32_t outline_frag[] = {
#include "shaders/outline.frag.inc"
};
constexpr std::uint32_t point_frag[] = {
#include "shaders/point.frag.inc"
};
constexpr std::uint32_t point_vert[] = {
#include "shaders/point.vert.inc"
};
constexpr std::uint32_t shape_frag[] = {
#include "shaders/shape.frag.inc"
};
constexpr std::uint32_t shape_vert[] = {
#include "shaders/shape.vert.inc"
};
constexpr std::uint32_t shape_outline_vert[] = {
#include "shaders/shape_outline.vert.inc"
};
constexpr std::uint32_t shape_shadow_vert[] = {
#include "shaders/shape_shadow.vert.inc"
};

using Code = std::span<const std::uint32_t>;

/// The parameters of one pipeline.
struct Recipe {
    Code vertex;
    Code fragment = {};  ///< empty: only depth is drawn
    vk::PrimitiveTopology topology = vk::PrimitiveTopology::eTriangleList;
    bool shape_vertices = false;  ///< vertices are ShapeVertex; otherwise the shader fetches or generates
                                  ///< them
    bool one_sided = false;
    bool behind_everything = false;  ///< covers only pixels without other surfaces
    bool over_everything = false;
    bool over_surfaces = false;  ///< in the second pass
    bool blended = false;        ///< alpha blending
};

/// The common parameters of the pipelines in a pass.
struct Pass {
    vk::RenderPass pass;
    bool casts_shadows = false;
};

vk::raii::Pipeline make_pipeline(const Device& device, vk::PipelineLayout layout, const Pass& pass,
                                 const Recipe& recipe)
{
    using Stage = vk::ShaderStageFlagBits;
    const auto vertex = device.make_shader(recipe.vertex);
    vk::raii::ShaderModule fragment{nullptr};
    std::vector<vk::PipelineShaderStageCreateInfo> stages{{{}, Stage::eVertex, *vertex, "main"}};
    if (!recipe.fragment.empty()) {
        fragment = device.make_shader(recipe.fragment);
        stages.push_back({{}, Stage::eFragment, *fragment, "main"});
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
    // The shadow map's y points up, which flips the winding.
    raster.frontFace = pass.casts_shadows ? vk::FrontFace::eClockwise : vk::FrontFace::eCounterClockwise;
    raster.lineWidth = 1;
    if (pass.casts_shadows) {
        // A surface nearly parallel to the sun's rays covers a large range of depth in one texel.
        raster.depthBiasEnable = VK_TRUE;
        raster.depthBiasConstantFactor = 2.0f;
        raster.depthBiasSlopeFactor = 2.0f;
    }
    const vk::PipelineMultisampleStateCreateInfo multisample({}, vk::SampleCountFlagBits::e1);
    const bool far = recipe.behind_everything, free = recipe.over_everything;
    const vk::PipelineDepthStencilStateCreateInfo depth(
        {}, !free, !far && !recipe.over_surfaces, far ? vk::CompareOp::eLessOrEqual : vk::CompareOp::eLess);
    using Channel = vk::ColorComponentFlagBits;
    vk::PipelineColorBlendAttachmentState blend;
    blend.colorWriteMask = Channel::eR | Channel::eG | Channel::eB | Channel::eA;
    if (recipe.blended) {
        using Factor = vk::BlendFactor;
        blend.blendEnable = VK_TRUE;
        blend.srcColorBlendFactor = Factor::eSrcAlpha, blend.dstColorBlendFactor = Factor::eOneMinusSrcAlpha;
        blend.srcAlphaBlendFactor = Factor::eZero, blend.dstAlphaBlendFactor = Factor::eOne;
    }
    vk::PipelineColorBlendStateCreateInfo blending;
    if (!pass.casts_shadows) blending.setAttachments(blend);
    const std::array<vk::DynamicState, 2> changing{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamic({}, changing);

    return {device.handle(), device.pipelines().cache(),
            vk::GraphicsPipelineCreateInfo({}, stages, &input, &assembly, nullptr, &viewport, &raster,
                                           &multisample, &depth, &blending, &dynamic, layout, pass.pass, 0)};
}

vk::raii::DescriptorSetLayout make_frame_set(const Device& device)
{
    using Stage = vk::ShaderStageFlagBits;
    const vk::DescriptorSetLayoutBinding bindings[] = {
        {0, vk::DescriptorType::eUniformBuffer, 1, Stage::eVertex | Stage::eFragment | Stage::eCompute},
        {1, vk::DescriptorType::eCombinedImageSampler, 1, Stage::eFragment}};
    return {device.handle(), vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::DescriptorSetLayout make_cloth_set(const Device& device, std::span<const std::uint32_t> of,
                                             vk::ShaderStageFlagBits stage)
{
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const std::uint32_t binding : of)
        bindings.emplace_back(binding, vk::DescriptorType::eStorageBuffer, 1, stage);
    return {device.handle(), vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::PipelineLayout make_layout(const Device& device, vk::DescriptorSetLayout frame,
                                     vk::DescriptorSetLayout cloth, vk::DescriptorSetLayout picture = {})
{
    const vk::DescriptorSetLayout all[] = {frame, cloth, picture};
    const vk::ArrayProxyNoTemporaries<const vk::DescriptorSetLayout> sets(picture ? 3u : 2u, all);
    const vk::PushConstantRange constants(push_constant_stages, 0, push_constant_bytes);
    return {device.handle(), vk::PipelineLayoutCreateInfo({}, sets, constants)};
}

vk::raii::Pipeline make_surface(const Device& device, vk::PipelineLayout layout)
{
    const auto module = device.make_shader(cloth_surface_comp);
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main");
    return {device.handle(), device.pipelines().cache(), vk::ComputePipelineCreateInfo({}, stage, layout)};
}

Recipe recipe_of(Drawn drawn)
{
    using Topology = vk::PrimitiveTopology;
    switch (drawn) {
        case Drawn::cloth_shadow: return {.vertex = cloth_shadow_vert};
        case Drawn::shape_shadow:
            return {.vertex = shape_shadow_vert, .shape_vertices = true, .one_sided = true};
        case Drawn::cloth: return {.vertex = cloth_vert, .fragment = cloth_frag};
        case Drawn::shape:
            return {.vertex = shape_vert, .fragment = shape_frag, .shape_vertices = true, .one_sided = true};
        case Drawn::ground:
            return {.vertex = ground_vert,
                    .fragment = ground_frag,
                    .topology = Topology::eTriangleStrip,
                    .one_sided = true};
        case Drawn::backdrop:
            return {.vertex = backdrop_vert, .fragment = backdrop_frag, .behind_everything = true};
        case Drawn::legend:
            return {.vertex = legend_vert,
                    .fragment = legend_frag,
                    .topology = Topology::eTriangleStrip,
                    .over_everything = true,
                    .over_surfaces = true};
        case Drawn::lines:
            return {.vertex = line_vert, .fragment = line_frag, .over_surfaces = true, .blended = true};
        case Drawn::points:
            return {.vertex = point_vert, .fragment = point_frag, .over_surfaces = true, .blended = true};
        case Drawn::drawn:
            return {.vertex = backdrop_vert,
                    .fragment = drawn_frag,
                    .over_everything = true,
                    .over_surfaces = true};
        case Drawn::cloth_outline:
            return {.vertex = cloth_outline_vert, .fragment = outline_frag, .over_surfaces = true};
        case Drawn::shape_outline:
            return {.vertex = shape_outline_vert, .fragment = outline_frag, .over_surfaces = true};
    }
    return {};
}

std::shared_ptr<Device> checked(std::shared_ptr<Device> device)
{
    const vk::PhysicalDeviceLimits limits = device->physical().getProperties().limits;
    for (const PictureShader& shader : picture_shaders()) {
        const LayoutNeeds layout{static_cast<std::uint32_t>(shader.cloth_bindings.size()), 1};
        const std::string beyond = beyond_limits(limits, needs_of(shader.code), layout);
        if (!beyond.empty())
            throw Error(ErrorKind::device_failure, "the Vulkan device " + device->info().name +
                                                       " cannot draw pictures with the shader " +
                                                       shader.name + ": " + beyond +
                                                       "; choose another with --device");
    }
    return device;
}

template <class T>
Buffer make_filled(const Device& device, const std::vector<T>& data, vk::BufferUsageFlags usage,
                   const char* name)
{
    Buffer buffer = device.make_buffer(data.size() * sizeof(T), usage, Memory::device, name);
    device.write(buffer, data.data(), data.size() * sizeof(T));
    return buffer;
}

/// Corners of edges, as input of shaders/shape_outline.vert.
std::vector<std::array<float, 4>> corners_of(const ShapeMeshes& meshes)
{
    std::vector<std::array<float, 4>> corners;
    for (const auto& [at, half, normal] : meshes.vertices) corners.push_back({at[0], at[1], at[2], half});
    return corners;
}

}  // namespace

std::span<const PictureShader> picture_shaders()
{
    static const PictureShader shaders[] = {{"backdrop.frag", backdrop_frag, drawn_bindings},
                                            {"backdrop.vert", backdrop_vert, drawn_bindings},
                                            {"cloth.frag", cloth_frag, drawn_bindings},
                                            {"cloth.vert", cloth_vert, drawn_bindings},
                                            {"cloth_outline.vert", cloth_outline_vert, drawn_bindings},
                                            {"cloth_shadow.vert", cloth_shadow_vert, drawn_bindings},
                                            {"cloth_surface.comp", cloth_surface_comp, surface_bindings},
                                            {"drawn.frag", drawn_frag, drawn_bindings},
                                            {"ground.frag", ground_frag, drawn_bindings},
                                            {"ground.vert", ground_vert, drawn_bindings},
                                            {"legend.frag", legend_frag, drawn_bindings},
                                            {"legend.vert", legend_vert, drawn_bindings},
                                            {"line.frag", line_frag, drawn_bindings},
                                            {"line.vert", line_vert, drawn_bindings},
                                            {"outline.frag", outline_frag, drawn_bindings},
                                            {"point.frag", point_frag, drawn_bindings},
                                            {"point.vert", point_vert, drawn_bindings},
                                            {"shape.frag", shape_frag, drawn_bindings},
                                            {"shape.vert", shape_vert, drawn_bindings},
                                            {"shape_outline.vert", shape_outline_vert, drawn_bindings},
                                            {"shape_shadow.vert", shape_shadow_vert, drawn_bindings}};
    return shaders;
}

PictureKit::PictureKit(std::shared_ptr<Device> device, PicturePassHandles passes)
    : device_(checked(std::move(device))),
      passes_(passes),
      shadow_map_(*device_),
      frame_set_(make_frame_set(*device_)),
      drawn_set_(make_cloth_set(*device_, drawn_bindings, vk::ShaderStageFlagBits::eVertex)),
      surface_set_(make_cloth_set(*device_, surface_bindings, vk::ShaderStageFlagBits::eCompute)),
      picture_set_(make_drawn_layout(*device_)),
      layout_(make_layout(*device_, *frame_set_, *drawn_set_, *picture_set_)),
      surface_layout_(make_layout(*device_, *frame_set_, *surface_set_)),
      surface_(make_surface(*device_, *surface_layout_)),
      pipelines_{nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
                 nullptr, nullptr, nullptr, nullptr, nullptr, nullptr},
      shapes_(make_shape_meshes()),
      shape_vertices_(
          make_filled(*device_, shapes_.vertices, vk::BufferUsageFlagBits::eVertexBuffer, "shape vertices")),
      shape_indices_(
          make_filled(*device_, shapes_.indices, vk::BufferUsageFlagBits::eIndexBuffer, "shape indices")),
      shape_corners_(make_filled(*device_, corners_of(shapes_), vk::BufferUsageFlagBits::eStorageBuffer,
                                 "shape corners")),
      shape_edges_(
          make_filled(*device_, shapes_.edges, vk::BufferUsageFlagBits::eStorageBuffer, "shape edges"))
{
    const vk::DescriptorPoolSize buffers(vk::DescriptorType::eStorageBuffer, drawn_bindings.size());
    pool_ = {device_->handle(), {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, buffers}};
    const vk::DescriptorSetLayout layout = *drawn_set_;
    shape_set_ = std::move(vk::raii::DescriptorSets(device_->handle(), {*pool_, layout}).front());
    const auto corners = shape_corners_.descriptor(), edges = shape_edges_.descriptor();
    device_->handle().updateDescriptorSets(
        {vk::WriteDescriptorSet(*shape_set_, 0, 0, vk::DescriptorType::eStorageBuffer, {}, corners),
         vk::WriteDescriptorSet(*shape_set_, 11, 0, vk::DescriptorType::eStorageBuffer, {}, edges)},
        {});
}

vk::Pipeline PictureKit::pipeline(Drawn drawn) const
{
    vk::raii::Pipeline& known = pipelines_[static_cast<std::size_t>(drawn)];
    if (*known) return *known;
    const Recipe recipe = recipe_of(drawn);
    const bool shadow = drawn == Drawn::cloth_shadow || drawn == Drawn::shape_shadow;
    const Pass shadows{.pass = shadow_map_.pass(), .casts_shadows = true};
    const Pass picture{.pass = recipe.over_surfaces ? passes_.picture : passes_.surfaces};
    known = make_pipeline(*device_, *layout_, shadow ? shadows : picture, recipe);
    return *known;
}

}  // namespace pliant::vulkan
