// The pipelines of a picture: one for each kind of thing, and one more for the shadow it casts.
#pragma once

#include "pliant/scene.hpp"
#include "render/picture_pass.hpp"

namespace pliant::vulkan {

struct Pipelines {
    Pipelines(const Device& device, const PictureTarget& target, vk::RenderPass shadow_pass,
              ClothColour colour);

    vk::raii::DescriptorSetLayout frame_set;  ///< set 0: uniforms and shadow map
    vk::raii::DescriptorSetLayout cloth_set;  ///< set 1: positions, normals, strains, place on the pattern
    vk::raii::PipelineLayout layout;          ///< one for all; push constants for what needs them

    vk::raii::Pipeline cloth_shadow, shape_shadow;
    vk::raii::Pipeline cloth, shape, ground, backdrop;
    vk::raii::Pipeline legend{nullptr};  ///< only with strain colours
};

constexpr std::uint32_t push_constant_bytes = 80;

}  // namespace pliant::vulkan
