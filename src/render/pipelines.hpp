// The pipelines of a picture: one for each kind of thing, and one more for the shadow it casts.
#pragma once

#include <array>
#include <cstdint>
#include <span>

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
    lines,   ///< springs, normals, edges
    points,  ///< contacts
    drawn,   ///< the surfaces, from the first pass into the second
    cloth_outline,
    shape_outline,
};
constexpr std::size_t drawn_count = 12;

/// Everything that pictures of one format need, whatever they show: scenes come and go, this stays.
class PictureKit {
public:
    /// For targets of these passes, of any size.
    /// Throws Error(device_failure) where a shader is beyond the limits of the device.
    PictureKit(std::shared_ptr<Device> device, PicturePassHandles passes);

    const std::shared_ptr<Device>& device() const { return device_; }
    const ShadowMap& shadow_map() const { return shadow_map_; }
    vk::DescriptorSetLayout frame_set() const { return *frame_set_; }
    vk::DescriptorSetLayout drawn_set() const { return *drawn_set_; }
    vk::DescriptorSetLayout surface_set() const { return *surface_set_; }
    vk::PipelineLayout layout() const { return *layout_; }
    vk::PipelineLayout surface_layout() const { return *surface_layout_; }
    /// Made when it is first asked for.
    vk::Pipeline pipeline(Drawn drawn) const;
    /// Computes what is seen of a cloth's nodes, in groups of `surface_group`: shaders/cloth_surface.comp.
    vk::Pipeline surface() const { return *surface_; }
    static constexpr std::uint32_t surface_group = 64;

    const ShapeMeshes& shapes() const { return shapes_; }
    vk::Buffer shape_vertices() const { return *shape_vertices_; }
    vk::Buffer shape_indices() const { return *shape_indices_; }
    /// Set 1 for the outlines of shapes.
    vk::DescriptorSet shape_set() const { return *shape_set_; }

private:
    std::shared_ptr<Device> device_;
    PicturePassHandles passes_;
    ShadowMap shadow_map_;
    vk::raii::DescriptorSetLayout frame_set_;                ///< set 0: uniforms and shadow map
    vk::raii::DescriptorSetLayout drawn_set_, surface_set_;  ///< set 1, see drawn_bindings
    vk::raii::DescriptorSetLayout picture_set_;              ///< set 2: what the first pass has drawn
    vk::raii::PipelineLayout layout_;  ///< one for all that is drawn; push constants for what needs them
    vk::raii::PipelineLayout surface_layout_;  ///< with the same push constants
    vk::raii::Pipeline surface_;
    mutable std::array<vk::raii::Pipeline, drawn_count> pipelines_;
    ShapeMeshes shapes_;
    Buffer shape_vertices_, shape_indices_, shape_corners_, shape_edges_;
    vk::raii::DescriptorPool pool_{nullptr};
    vk::raii::DescriptorSet shape_set_{nullptr};
};

constexpr std::uint32_t push_constant_bytes = 96;

/// Storage buffers of shaders/cloth_nodes.glsl: what is drawn binds some of them, cloth_surface.comp others.
/// Both together would be more than some devices can bind at once.
constexpr std::uint32_t cloth_binding_count = 12;
constexpr std::array<std::uint32_t, 8> drawn_bindings{0, 1, 2, 3, 5, 6, 7, 11};
constexpr std::array<std::uint32_t, 7> surface_bindings{0, 1, 2, 4, 8, 9, 10};

/// A shader of pictures, and which buffers of a cloth its layout binds.
struct PictureShader {
    const char* name;
    std::span<const std::uint32_t> code;
    std::span<const std::uint32_t> cloth_bindings;
};
std::span<const PictureShader> picture_shaders();

constexpr vk::ShaderStageFlags push_constant_stages =
    vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment | vk::ShaderStageFlagBits::eCompute;

}  // namespace pliant::vulkan
