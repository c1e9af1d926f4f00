#include "render/scene_drawing.hpp"

#include <cstring>

#include "render/cloth_pattern.hpp"

namespace pliant::vulkan {
namespace {

using Usage = vk::BufferUsageFlagBits;

constexpr vk::Extent2D legend_least{400, 240};  // pixels; in smaller pictures it would hide the cloth

template <class T>
Buffer make_filled(const Device& device, const std::vector<T>& data, vk::BufferUsageFlags usage,
                   const char* name)
{
    Buffer buffer = device.make_buffer(data.size() * sizeof(T), usage, Memory::device, name);
    device.write(buffer, data.data(), data.size() * sizeof(T));
    return buffer;
}

/// Nodes are vec4 on the device.
void copy_nodes(std::span<const Vec3> from, const Buffer& to)
{
    auto* out = static_cast<float*>(to.mapped);
    for (const Vec3& v : from) {
        out[0] = v.x, out[1] = v.y, out[2] = v.z, out[3] = 0;
        out += 4;
    }
}

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorKind::bad_usage, message); }

}  // namespace

SceneDrawing::SceneDrawing(std::shared_ptr<Device> device, const Scene& scene,
                           std::span<const ClothTopology> topologies, const PictureTarget& target)
    : device_(std::move(device)),
      colliders_(scene.colliders),
      stage_(make_stage(scene)),
      shadow_map_(*device_),
      pipelines_(*device_, target, shadow_map_.pass(), scene.camera.colour),
      uniforms_(device_->make_buffer(sizeof(FrameUniforms), Usage::eUniformBuffer, Memory::upload, "frame")),
      shapes_(make_shape_meshes()),
      shape_vertices_(make_filled(*device_, shapes_.vertices, Usage::eVertexBuffer, "shape vertices")),
      shape_indices_(make_filled(*device_, shapes_.indices, Usage::eIndexBuffer, "shape indices"))
{
    if (topologies.size() != scene.cloth_count())
        refuse("a picture needs the topology of each cloth of the scene: it has " +
               std::to_string(scene.cloth_count()) + ", and " + std::to_string(topologies.size()) +
               " were given");
    const auto count = static_cast<std::uint32_t>(topologies.size());
    const vk::DescriptorPoolSize sizes[] = {{vk::DescriptorType::eUniformBuffer, 1},
                                            {vk::DescriptorType::eCombinedImageSampler, 1},
                                            {vk::DescriptorType::eStorageBuffer, 4 * std::max(1u, count)}};
    pool_ = {device_->handle(), {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1 + count, sizes}};
    bind_frame_set();
    for (std::size_t i = 0; i < topologies.size(); ++i)
        cloths_.push_back(make_cloth(scene.cloth(i), topologies[i]));
    placed_.resize(colliders_.size());
}

void SceneDrawing::bind_frame_set()
{
    frame_set_ =
        std::move(vk::raii::DescriptorSets(device_->handle(), {*pool_, *pipelines_.frame_set}).front());
    const auto frame = uniforms_.descriptor();
    const auto map = shadow_map_.descriptor();
    device_->handle().updateDescriptorSets(
        {vk::WriteDescriptorSet(*frame_set_, 0, 0, vk::DescriptorType::eUniformBuffer, {}, frame),
         vk::WriteDescriptorSet(*frame_set_, 1, 0, vk::DescriptorType::eCombinedImageSampler, map)},
        {});
}

SceneDrawing::ClothDrawing SceneDrawing::make_cloth(const Cloth& cloth, const ClothTopology& topology) const
{
    if (topology.rows * std::uint64_t{topology.columns} > topology.node_count)
        refuse("a sheet of " + std::to_string(topology.rows) + " x " + std::to_string(topology.columns) +
               " has more than the " + std::to_string(topology.node_count) + " nodes that were given");
    for (const Triangle& triangle : topology.triangles)
        for (const auto node : triangle)
            if (node >= topology.node_count)
                refuse("a triangle of a picture names the node " + std::to_string(node) + " of " +
                       std::to_string(topology.node_count));
    ClothDrawing drawing;
    drawing.node_count = topology.node_count;
    drawing.index_count = static_cast<std::uint32_t>(3 * topology.triangles.size());
    drawing.indices = device_->make_buffer(topology.triangles.size_bytes(), Usage::eIndexBuffer,
                                           Memory::device, "cloth triangles");
    device_->write(drawing.indices, topology.triangles.data(), topology.triangles.size_bytes());
    drawing.pattern =
        make_filled(*device_, cloth_pattern(cloth, topology.rows, topology.columns, topology.node_count),
                    Usage::eStorageBuffer, "cloth pattern");
    drawing.set =
        std::move(vk::raii::DescriptorSets(device_->handle(), {*pool_, *pipelines_.cloth_set}).front());
    return drawing;
}

void SceneDrawing::prepare(const Camera& camera, vk::Extent2D size, double time,
                           std::span<const ClothFrame> frames)
{
    if (frames.size() != cloths_.size())
        refuse("a picture needs " + std::to_string(cloths_.size()) + " cloths, and " +
               std::to_string(frames.size()) + " were given");
    for (std::size_t i = 0; i < frames.size(); ++i) bind_frame(cloths_[i], frames[i]);
    for (std::size_t i = 0; i < colliders_.size(); ++i) placed_[i] = placed_at(colliders_[i], time);
    const FrameUniforms uniforms = frame_uniforms(stage_, camera, size.width, size.height, ShadowMap::edge);
    std::memcpy(uniforms_.mapped, &uniforms, sizeof uniforms);
}

void SceneDrawing::record(const vk::raii::CommandBuffer& commands, const PictureTarget& target) const
{
    // What computed or uploaded the nodes has been submitted before; here it becomes visible.
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    barrier(commands, Stage::eComputeShader | Stage::eTransfer, Access::eShaderWrite | Access::eTransferWrite,
            Stage::eVertexInput | Stage::eVertexShader,
            Access::eShaderRead | Access::eIndexRead | Access::eVertexAttributeRead);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layout, 0, *frame_set_, {});
    record_shadows(commands);
    record_picture(commands, target);
}

void SceneDrawing::bind_frame(ClothDrawing& cloth, const ClothFrame& frame) const
{
    const auto* host = std::get_if<HostCloth>(&frame);
    const DeviceClothBuffers buffers = host ? upload(cloth, *host) : std::get<DeviceClothBuffers>(frame);
    if (!host && buffers.node_count != cloth.node_count)
        refuse("a picture of a cloth of " + std::to_string(cloth.node_count) +
               " nodes was given buffers of " + std::to_string(buffers.node_count));
    if (buffers.position == cloth.bound.position && buffers.normal == cloth.bound.normal &&
        buffers.strain == cloth.bound.strain)
        return;
    cloth.bound = buffers;
    const std::array<vk::DescriptorBufferInfo, 4> infos{
        vk::DescriptorBufferInfo(buffers.position, 0, VK_WHOLE_SIZE),
        {buffers.normal, 0, VK_WHOLE_SIZE},
        {buffers.strain, 0, VK_WHOLE_SIZE},
        cloth.pattern.descriptor()};
    device_->handle().updateDescriptorSets(
        vk::WriteDescriptorSet(*cloth.set, 0, 0, vk::DescriptorType::eStorageBuffer, {}, infos), {});
}

DeviceClothBuffers SceneDrawing::upload(ClothDrawing& cloth, const HostCloth& frame) const
{
    const auto matches = [&](std::size_t size) { return size == cloth.node_count; };
    if (!matches(frame.positions.size()) || !matches(frame.normals.size()) ||
        (!frame.strains.empty() && !matches(frame.strains.size())))
        refuse("a picture of a cloth of " + std::to_string(cloth.node_count) + " nodes was given " +
               std::to_string(frame.positions.size()) + " positions, " +
               std::to_string(frame.normals.size()) + " normals and " + std::to_string(frame.strains.size()) +
               " strains");
    if (cloth.positions.size == 0) {
        const auto make = [&](std::size_t size, const char* name) {
            return device_->make_buffer(size * cloth.node_count, Usage::eStorageBuffer, Memory::upload, name);
        };
        cloth.positions = make(4 * sizeof(float), "uploaded positions");
        cloth.normals = make(4 * sizeof(float), "uploaded normals");
        cloth.strains = make(sizeof(float), "uploaded strains");
    }
    copy_nodes(frame.positions, cloth.positions);
    copy_nodes(frame.normals, cloth.normals);
    if (frame.strains.empty())
        std::memset(cloth.strains.mapped, 0, cloth.node_count * sizeof(float));
    else
        std::memcpy(cloth.strains.mapped, frame.strains.data(), frame.strains.size_bytes());
    return {*cloth.positions, *cloth.normals, *cloth.strains, cloth.node_count};
}

void SceneDrawing::record_shadows(const vk::raii::CommandBuffer& commands) const
{
    shadow_map_.begin(commands);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_.cloth_shadow);
    draw_cloths(commands);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_.shape_shadow);
    draw_shapes(commands);
    shadow_map_.end(commands);
}

void SceneDrawing::record_picture(const vk::raii::CommandBuffer& commands, const PictureTarget& target) const
{
    // Attachments: colours (covered by the backdrop, not cleared), depth.
    const std::array<vk::ClearValue, 2> clear{vk::ClearColorValue{}, vk::ClearDepthStencilValue(1.0f, 0)};
    const vk::Rect2D area({}, target.size);
    commands.beginRenderPass(vk::RenderPassBeginInfo(target.pass, target.framebuffer, area, clear),
                             vk::SubpassContents::eInline);
    commands.setViewport(0, vk::Viewport(0, 0, static_cast<float>(target.size.width),
                                         static_cast<float>(target.size.height), 0, 1));
    commands.setScissor(0, area);

    // From the front to the back, so that what is hidden costs no shading.
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_.cloth);
    draw_cloths(commands);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_.shape);
    draw_shapes(commands);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_.ground);
    draw_floors(commands);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_.backdrop);
    commands.draw(3, 1, 0, 0);
    if (*pipelines_.legend && target.size.width >= legend_least.width &&
        target.size.height >= legend_least.height) {
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_.legend);
        commands.draw(4, 1, 0, 0);
    }
    commands.endRenderPass();
}

void SceneDrawing::draw_cloths(const vk::raii::CommandBuffer& commands) const
{
    for (const ClothDrawing& cloth : cloths_) {
        if (cloth.index_count == 0) continue;
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layout, 1, *cloth.set, {});
        commands.bindIndexBuffer(*cloth.indices, 0, vk::IndexType::eUint32);
        commands.drawIndexed(cloth.index_count, 1, 0, 0, 0);
    }
}

void SceneDrawing::draw_shapes(const vk::raii::CommandBuffer& commands) const
{
    commands.bindVertexBuffers(0, *shape_vertices_, vk::DeviceSize{0});
    commands.bindIndexBuffer(*shape_indices_, 0, vk::IndexType::eUint32);
    for (const PlacedCollider& collider : placed_) {
        if (is_ground(collider)) continue;
        push(commands, placement_of(collider, stage_.inset));
        const auto range = mesh_of(collider, shapes_);
        commands.drawIndexed(range.index_count, 1, range.first_index, 0, 0);
    }
}

void SceneDrawing::draw_floors(const vk::raii::CommandBuffer& commands) const
{
    const auto draw = [&](double height, bool collider) {
        push(commands, ground_at(stage_, height, collider));
        commands.draw(4, 1, 0, 0);
    };
    for (const PlacedCollider& collider : placed_)
        if (is_ground(collider)) draw(collider.centre.y, true);
    if (!stage_.has_plane) draw(stage_.floor_height, false);
}

template <class Constants>
void SceneDrawing::push(const vk::raii::CommandBuffer& commands, const Constants& constants) const
{
    commands.pushConstants<Constants>(*pipelines_.layout,
                                      vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment,
                                      0, constants);
}

}  // namespace pliant::vulkan
