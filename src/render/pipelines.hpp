// The pipelines of a picture: one per kind of object, and one more for its shadow.
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
    drawn,   ///< copies the surfaces from the first pass into the second
    cloth_outline,
    shape_outline,
};
constexpr std::size_t drawn_count = 12;

/// The objects that all pictures of one format share, independent of the scene.
class PictureKit {
public:
    /// For targets of these passes, of any size. Throws Error(device_failure) if a shader exceeds the
    /// device's limits.
    PictureKit(std::shared_ptr<Device> device, PicturePassHandles passes);

    const std::shared_ptr<Device>& device() const { return device_; }
    const ShadowMap& shadow_map() const { return shadow_map_; }
    vk::DescriptorSetLayout frame_set() const { return *frame_set_; }
    vk::DescriptorSetLayout drawn_set() const { return *drawn_set_; }
    vk::DescriptorSetLayout surface_set() const { return *surface_set_; }
    vk::PipelineLayout layout() const { return *layout_; }
    vk::PipelineLayout surface_layout() const { return *surface_layout_; }
    /// Made on first use.
    vk::Pipeline pipeline(Drawn drawn) const;
    /// Computes the visible state of a cloth's nodes, in groups of `surface_group`:
    /// shaders/cloth_surface.comp.
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
    vk::raii::DescriptorSetLayout picture_set_;              ///< set 2: the result of the first pass
    vk::raii::PipelineLayout layout_;  ///< shared by all drawing pipelines, with push constants for those
                                       ///< that need them
    vk::raii::PipelineLayout surface_layout_;  ///< with the same push constants
    vk::raii::Pipeline surface_;
    mutable std::array<vk::raii::Pipeline, drawn_count> pipelines_;
    ShapeMeshes shapes_;
    Buffer shape_vertices_, shape_indices_, shape_corners_, shape_edges_;
    vk::raii::DescriptorPool pool_{nullptr};
    vk::raii::DescriptorSet shape_set_{nullptr};
};

constexpr std::uint32_t push_constant_bytes = 96;

/// Storage buffers of shaders/cloth_nodes.glsl: drawing shaders bind some of them, cloth_surface.comp others.
/// All together would exceed the limits of some devices.
constexpr std::uint32_t cloth_binding_count = 12;
constexpr std::array<std::uint32_t, 8> drawn_bindings{0, 1, 2, 3, 5, 6, 7, 11};
constexpr std::array<std::uint32_t, 7> surface_bindings{0, 1, 2, 4, 8, 9, 10};

/// A shader of pictures, and the cloth buffers in its layout.
struct PictureShader {
    const char* name;
    std::span<const std::uint32_t> code;
    std::span<const std::uint32_t> cloth_bindings;
};
std::span<const PictureShader> picture_shaders();

constexpr vk::ShaderStageFlags push_constant_stages =
    vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment | vk::ShaderStageFlagBits::eCompute;

}  // namespace pliant::vulkan
