// The pipelines of a picture: one for each kind of thing, and one more for the shadow it casts.
#pragma once

#include <array>

#include "render/picture_pass.hpp"
#include "render/shadow_map.hpp"
#include "render/shapes.hpp"

namespace pliant::vulkan {

enum class Drawn : std::uint8_t {
    cloth_shadow,
    shape_shadow,
    cloth,
    shape,
    ground,
    backdrop,
    legend,
    lines,   ///< springs, normals
    points,  ///< contacts
    wires,   ///< triangles as lines
};
constexpr std::size_t drawn_count = 10;

/// Everything that pictures of one format need, whatever they show: scenes come and go, this stays.
class PictureKit {
public:
    /// For targets like this one: its pass and samples, any size.
    PictureKit(std::shared_ptr<Device> device, vk::RenderPass pass, vk::SampleCountFlagBits samples);

    const std::shared_ptr<Device>& device() const { return device_; }
    const ShadowMap& shadow_map() const { return shadow_map_; }
    vk::DescriptorSetLayout frame_set() const { return *frame_set_; }
    vk::DescriptorSetLayout cloth_set() const { return *cloth_set_; }
    vk::PipelineLayout layout() const { return *layout_; }
    /// Made when it is first asked for. Null for wires on a device that cannot draw them.
    vk::Pipeline pipeline(Drawn drawn) const;
    /// Computes what is seen of a cloth's nodes, in groups of `surface_group`: shaders/cloth_surface.comp.
    vk::Pipeline surface() const { return *surface_; }
    static constexpr std::uint32_t surface_group = 64;

    const ShapeMeshes& shapes() const { return shapes_; }
    vk::Buffer shape_vertices() const { return *shape_vertices_; }
    vk::Buffer shape_indices() const { return *shape_indices_; }

private:
    std::shared_ptr<Device> device_;
    vk::RenderPass pass_;
    vk::SampleCountFlagBits samples_;
    ShadowMap shadow_map_;
    vk::raii::DescriptorSetLayout frame_set_;  ///< set 0: uniforms and shadow map
    vk::raii::DescriptorSetLayout cloth_set_;  ///< set 1: shaders/cloth_nodes.glsl
    vk::raii::PipelineLayout layout_;          ///< one for all; push constants for what needs them
    vk::raii::Pipeline surface_;
    mutable std::array<vk::raii::Pipeline, drawn_count> pipelines_;
    ShapeMeshes shapes_;
    Buffer shape_vertices_, shape_indices_;
};

constexpr std::uint32_t push_constant_bytes = 80;
constexpr std::uint32_t cloth_binding_count = 11;
constexpr vk::ShaderStageFlags push_constant_stages =
    vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment | vk::ShaderStageFlagBits::eCompute;

}  // namespace pliant::vulkan
