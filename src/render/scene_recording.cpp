// Records the commands of a picture.
#include <algorithm>

#include "render/scene_drawing.hpp"

namespace pliant::vulkan {
namespace {

constexpr vk::Extent2D legend_least{400, 240};  // pixels; in smaller pictures the legend would cover the
                                                // cloth

/// As in shaders/cloth_surface.comp.
struct SurfaceStyle {
    std::uint32_t node_count, rows, columns, stride, strain;
};

/// As in shaders/line.vert.
enum class LineKind : std::uint32_t { springs, held, normals, edges };
struct LineStyle {
    LineKind kind = LineKind::springs;
    float length = 0;  ///< m
    std::uint32_t count = 0;
};

/// A part of a picture plus the neighbouring pixels of surfaces that shaders/drawn.frag reads, up to two
/// pixels away.
vk::Rect2D grown(const vk::Rect2D& part, vk::Extent2D size)
{
    constexpr std::int32_t reach = 2;  // pixels
    const std::int32_t left = std::max(0, part.offset.x - reach), top = std::max(0, part.offset.y - reach);
    const auto end = [](std::int32_t offset, std::uint32_t length, std::uint32_t whole) {
        return std::min(whole, static_cast<std::uint32_t>(offset + reach) + length);
    };
    return {{left, top},
            {end(part.offset.x, part.extent.width, size.width) - static_cast<std::uint32_t>(left),
             end(part.offset.y, part.extent.height, size.height) - static_cast<std::uint32_t>(top)}};
}

}  // namespace

void SceneDrawing::begin(const vk::raii::CommandBuffer& commands, const PictureTarget& target,
                         unsigned slot) const
{
    record_surfaces(commands, slot);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, kit_->layout(), 0, *slots_[slot].frame_set,
                                {});
    record_shadows(commands, slot);
    record_picture(commands, target, slot);
}

void SceneDrawing::record_surfaces(const vk::raii::CommandBuffer& commands, unsigned slot) const
{
    // Makes the nodes visible that earlier submissions computed or copied. The last picture may also still be
    // reading what is written now.
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    barrier(commands, Stage::eComputeShader | Stage::eTransfer | Stage::eVertexShader,
            Access::eShaderWrite | Access::eTransferWrite, Stage::eComputeShader,
            Access::eShaderRead | Access::eShaderWrite);
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, kit_->surface());
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, kit_->surface_layout(), 0,
                                *slots_[slot].frame_set, {});
    const bool strain = slots_[slot].overlays.has(Overlay::strain);
    for (const ClothDrawing& cloth : cloths_) {
        const ClothSlot& of = cloth.slots[slot];
        commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, kit_->surface_layout(), 1,
                                    *of.surface_set, {});
        push(commands, SurfaceStyle{cloth.node_count, cloth.rows, cloth.columns, of.stride,
                                    strain && cloth.neighbours.size > 0 && !of.has_values ? 1u : 0u});
        commands.dispatch((cloth.node_count + PictureKit::surface_group - 1) / PictureKit::surface_group, 1,
                          1);
    }
    barrier(commands, Stage::eComputeShader, Access::eShaderWrite, Stage::eVertexInput | Stage::eVertexShader,
            Access::eShaderRead | Access::eIndexRead | Access::eVertexAttributeRead);
}

void SceneDrawing::bind(const vk::raii::CommandBuffer& commands, Drawn drawn) const
{
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, kit_->pipeline(drawn));
}

void SceneDrawing::bind_set(const vk::raii::CommandBuffer& commands, const ClothSlot& slot) const
{
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, kit_->layout(), 1, *slot.drawn_set, {});
}

void SceneDrawing::record_shadows(const vk::raii::CommandBuffer& commands, unsigned slot) const
{
    kit_->shadow_map().begin(commands);
    bind(commands, Drawn::cloth_shadow);
    draw_cloths(commands, slot);
    bind(commands, Drawn::shape_shadow);
    draw_shapes(commands, slot);
    kit_->shadow_map().end(commands);
}

void SceneDrawing::record_picture(const vk::raii::CommandBuffer& commands, const PictureTarget& target,
                                  unsigned slot) const
{
    // Attachments: colours (the backdrop covers them, so they are not cleared), depth.
    const std::array<vk::ClearValue, 2> clear{vk::ClearColorValue{}, vk::ClearDepthStencilValue(1.0f, 0)};
    const vk::Rect2D area = grown(target.part, target.size);
    commands.beginRenderPass(vk::RenderPassBeginInfo(target.passes.surfaces, target.surfaces, area, clear),
                             vk::SubpassContents::eInline);
    commands.setViewport(0, vk::Viewport(0, 0, static_cast<float>(target.size.width),
                                         static_cast<float>(target.size.height), 0, 1));
    commands.setScissor(0, area);
    // Front to back, so that hidden surfaces need no shading.
    bind(commands, Drawn::cloth);
    draw_cloths(commands, slot);
    bind(commands, Drawn::shape);
    draw_shapes(commands, slot);
    bind(commands, Drawn::ground);
    draw_floors(commands, slot);
    bind(commands, Drawn::backdrop);
    commands.draw(3, 1, 0, 0);
    commands.endRenderPass();

    commands.beginRenderPass(vk::RenderPassBeginInfo(target.passes.picture, target.picture, target.part),
                             vk::SubpassContents::eInline);
    commands.setScissor(0, target.part);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, kit_->layout(), 2, target.drawn, {});
    bind(commands, Drawn::drawn);
    commands.draw(3, 1, 0, 0);
    draw_outlines(commands, slot);
    draw_overlays(commands, target.size, slot);
}

void SceneDrawing::draw_outlines(const vk::raii::CommandBuffer& commands, unsigned slot) const
{
    bind(commands, Drawn::cloth_outline);
    for (const ClothDrawing& cloth : cloths_) {
        bind_set(commands, cloth.slots[slot]);
        commands.draw(3 * cloth.edge_count, 1, 0, 0);
    }
    bind(commands, Drawn::shape_outline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, kit_->layout(), 1, kit_->shape_set(), {});
    for (const PlacedCollider& collider : slots_[slot].placed) {
        if (is_ground(collider)) continue;
        push(commands, placement_of(collider, stage_.inset));
        const auto range = mesh_of(collider, kit_->shapes());
        commands.draw(3 * range.edge_count, 1, 3 * range.first_edge, 0);
    }
}

void SceneDrawing::draw_overlays(const vk::raii::CommandBuffer& commands, vk::Extent2D size,
                                 unsigned slot) const
{
    const OverlaySet shown = slots_[slot].overlays;
    const auto draw_lines = [&](LineKind kind, float length = 0) {
        bind(commands, Drawn::lines);
        for (const ClothDrawing& cloth : cloths_) {
            bind_set(commands, cloth.slots[slot]);
            std::uint32_t count = cloth.line_count;
            if (kind == LineKind::held && !cloth.slots[slot].has_held) count = 0;
            if (kind == LineKind::normals) count = cloth.node_count;
            if (kind == LineKind::edges) count = cloth.edge_count;
            push(commands, LineStyle{kind, length, count});
            commands.draw(6 * count, 1, 0, 0);
        }
    };
    if (shown.has(Overlay::wireframe)) draw_lines(LineKind::edges);
    if (shown.has(Overlay::springs)) draw_lines(LineKind::springs);
    if (shown.has(Overlay::active)) draw_lines(LineKind::held);
    if (shown.has(Overlay::normals))
        draw_lines(LineKind::normals, static_cast<float>(0.02 * stage_.view_distance));
    if (shown.has(Overlay::contacts)) {
        bind(commands, Drawn::points);
        for (const ClothDrawing& cloth : cloths_) {
            bind_set(commands, cloth.slots[slot]);
            commands.draw(6 * cloth.slots[slot].point_count, 1, 0, 0);
        }
    }
    if (shown.has_colours() && size.width >= legend_least.width && size.height >= legend_least.height) {
        bind(commands, Drawn::legend);
        push(commands, slots_[slot].legend);
        commands.draw(4, 1, 0, 0);
    }
}

void SceneDrawing::draw_cloths(const vk::raii::CommandBuffer& commands, unsigned slot) const
{
    for (std::uint32_t i = 0; i < cloths_.size(); ++i) {
        const ClothDrawing& cloth = cloths_[i];
        if (cloth.index_count == 0) continue;
        bind_set(commands, cloth.slots[slot]);
        commands.bindIndexBuffer(*cloth.indices, 0, vk::IndexType::eUint32);
        commands.drawIndexed(cloth.index_count, 1, 0, 0, i);
    }
}

void SceneDrawing::draw_shapes(const vk::raii::CommandBuffer& commands, unsigned slot) const
{
    commands.bindVertexBuffers(0, kit_->shape_vertices(), vk::DeviceSize{0});
    commands.bindIndexBuffer(kit_->shape_indices(), 0, vk::IndexType::eUint32);
    for (std::uint32_t i = 0; i < slots_[slot].placed.size(); ++i) {
        const PlacedCollider& collider = slots_[slot].placed[i];
        if (is_ground(collider)) continue;
        push(commands, placement_of(collider, stage_.inset));
        const auto range = mesh_of(collider, kit_->shapes());
        commands.drawIndexed(range.index_count, 1, range.first_index, 0, i);
    }
}

void SceneDrawing::draw_floors(const vk::raii::CommandBuffer& commands, unsigned slot) const
{
    const auto draw = [&](double height, bool collider) {
        push(commands, ground_at(stage_, height, collider));
        commands.draw(4, 1, 0, 0);
    };
    for (const PlacedCollider& collider : slots_[slot].placed)
        if (is_ground(collider)) draw(collider.centre.y, true);
    if (!stage_.has_plane) draw(stage_.floor_height, false);
}

template <class Constants>
void SceneDrawing::push(const vk::raii::CommandBuffer& commands, const Constants& constants) const
{
    commands.pushConstants<Constants>(kit_->layout(), push_constant_stages, 0, constants);
}

}  // namespace pliant::vulkan
