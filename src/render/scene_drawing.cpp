#include "render/scene_drawing.hpp"

#include <cstring>

#include "render/cloth_pattern.hpp"

namespace pliant::vulkan {
namespace {

using Usage = vk::BufferUsageFlagBits;

constexpr vk::Extent2D legend_least{400, 240};  // pixels; in smaller pictures it would hide the cloth

/// Nodes are vec4 on the device.
void copy_nodes(std::span<const Vec3> from, const Buffer& to)
{
    auto* out = static_cast<float*>(to.mapped);
    for (const Vec3& v : from) {
        out[0] = v.x, out[1] = v.y, out[2] = v.z, out[3] = 0;
        out += 4;
    }
}

/// As shaders/line.vert.
struct LineStyle {
    std::uint32_t kind = 0;
    float length = 0;  ///< m
};

bool has_colours(OverlaySet overlays)
{
    return overlays.has(Overlay::strain) || overlays.has(Overlay::multipliers) ||
           overlays.has(Overlay::volume);
}

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorKind::bad_usage, message); }

}  // namespace

SceneDrawing::SceneDrawing(std::shared_ptr<const PictureKit> kit, const Scene& scene,
                           std::span<const ClothTopology> topologies, unsigned slots)
    : kit_(std::move(kit)),
      device_(kit_->device()),
      colliders_(scene.colliders),
      stage_(make_stage(scene)),
      nothing_(device_->make_buffer(16, Usage::eStorageBuffer, Memory::device, "nothing"))
{
    if (topologies.size() != scene.cloth_count())
        refuse("a picture needs the topology of each cloth of the scene: it has " +
               std::to_string(scene.cloth_count()) + ", and " + std::to_string(topologies.size()) +
               " were given");
    const auto cloths = static_cast<std::uint32_t>(topologies.size());
    const vk::DescriptorPoolSize sizes[] = {
        {vk::DescriptorType::eUniformBuffer, slots},
        {vk::DescriptorType::eCombinedImageSampler, slots},
        {vk::DescriptorType::eStorageBuffer, slots * cloth_binding_count * std::max(1u, cloths)}};
    pool_ = {device_->handle(),
             {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, slots * (1 + cloths), sizes}};
    for (unsigned k = 0; k < slots; ++k) slots_.push_back(make_slot());
    for (std::size_t i = 0; i < topologies.size(); ++i)
        cloths_.push_back(make_cloth(scene.cloth(i), topologies[i], slots));
}

SceneDrawing::Slot SceneDrawing::make_slot() const
{
    Slot slot;
    slot.uniforms =
        device_->make_buffer(sizeof(FrameUniforms), Usage::eUniformBuffer, Memory::upload, "frame");
    slot.placed.resize(colliders_.size());
    const vk::DescriptorSetLayout layout = kit_->frame_set();
    slot.frame_set = std::move(vk::raii::DescriptorSets(device_->handle(), {*pool_, layout}).front());
    const auto frame = slot.uniforms.descriptor();
    const auto map = kit_->shadow_map().descriptor();
    device_->handle().updateDescriptorSets(
        {vk::WriteDescriptorSet(*slot.frame_set, 0, 0, vk::DescriptorType::eUniformBuffer, {}, frame),
         vk::WriteDescriptorSet(*slot.frame_set, 1, 0, vk::DescriptorType::eCombinedImageSampler, map)},
        {});
    return slot;
}

SceneDrawing::ClothDrawing SceneDrawing::make_cloth(const Cloth& cloth, const ClothTopology& topology,
                                                    unsigned slots) const
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
    const auto pattern = cloth_pattern(cloth, topology.rows, topology.columns, topology.node_count);
    const std::size_t pattern_bytes = pattern.size() * sizeof(pattern.front());
    drawing.pattern =
        device_->make_buffer(pattern_bytes, Usage::eStorageBuffer, Memory::device, "cloth pattern");
    device_->write(drawing.pattern, pattern.data(), pattern_bytes);
    const vk::DescriptorSetLayout layout = kit_->cloth_set();
    for (unsigned k = 0; k < slots; ++k)
        drawing.slots.emplace_back().set =
            std::move(vk::raii::DescriptorSets(device_->handle(), {*pool_, layout}).front());
    return drawing;
}

void SceneDrawing::set_springs(std::size_t cloth, std::span<const DrawnSpring> springs)
{
    ClothDrawing& drawing = cloths_.at(cloth);
    drawing.lines =
        device_->make_buffer(springs.size_bytes(), Usage::eStorageBuffer, Memory::device, "drawn springs");
    device_->write(drawing.lines, springs.data(), springs.size_bytes());
    drawing.line_count = static_cast<std::uint32_t>(springs.size());
}

void SceneDrawing::keep(const vk::raii::CommandBuffer& commands, std::span<const vk::Buffer> positions)
{
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    // What computed the positions, and what still draws from the last copy.
    barrier(commands, Stage::eComputeShader | Stage::eVertexShader | Stage::eTransfer,
            Access::eShaderWrite | Access::eTransferWrite, Stage::eTransfer,
            Access::eTransferRead | Access::eTransferWrite);
    for (std::size_t c = 0; c < cloths_.size() && c < positions.size(); ++c) {
        const vk::DeviceSize bytes = vk::DeviceSize{4} * sizeof(float) * cloths_[c].node_count;
        if (cloths_[c].kept.size == 0)
            cloths_[c].kept =
                device_->make_buffer(bytes, Usage::eStorageBuffer, Memory::device, "positions before");
        commands.copyBuffer(positions[c], *cloths_[c].kept, vk::BufferCopy(0, 0, bytes));
    }
    barrier(commands, Stage::eTransfer, Access::eTransferRead | Access::eTransferWrite,
            Stage::eComputeShader | Stage::eVertexShader, Access::eShaderRead | Access::eShaderWrite);
}

void SceneDrawing::prepare(const PictureState& state, vk::Extent2D size, unsigned slot_index)
{
    if (state.frames.size() != cloths_.size())
        refuse("a picture needs " + std::to_string(cloths_.size()) + " cloths, and " +
               std::to_string(state.frames.size()) + " were given");
    if (!state.extras.empty() && state.extras.size() != cloths_.size())
        refuse("a picture needs what overlays show for all of its cloths, or for none");
    Slot& slot = slots_.at(slot_index);
    slot.overlays = state.overlays;
    static const ValueScale of_strains;
    const ValueScale& scale = state.scale ? *state.scale : of_strains;
    slot.legend = legend_text(scale);
    for (std::size_t i = 0; i < cloths_.size(); ++i)
        bind_cloth(cloths_[i], cloths_[i].slots[slot_index], state.frames[i],
                   state.extras.empty() ? ClothExtras{} : state.extras[i], state.overlays, state.blend);
    for (std::size_t i = 0; i < colliders_.size(); ++i) slot.placed[i] = placed_at(colliders_[i], state.time);
    FrameUniforms uniforms = frame_uniforms(stage_, state.camera, size.width, size.height, ShadowMap::edge);
    uniforms.value_low = scale.low;
    uniforms.value_high = scale.high;
    uniforms.blend = state.blend;
    if (has_colours(state.overlays)) uniforms.colours = scale.diverging ? 2 : 1;
    std::memcpy(slot.uniforms.mapped, &uniforms, sizeof uniforms);
}

void SceneDrawing::begin(const vk::raii::CommandBuffer& commands, const PictureTarget& target,
                         unsigned slot) const
{
    // What computed or uploaded the nodes has been submitted before; here it becomes visible.
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    barrier(commands, Stage::eComputeShader | Stage::eTransfer, Access::eShaderWrite | Access::eTransferWrite,
            Stage::eVertexInput | Stage::eVertexShader,
            Access::eShaderRead | Access::eIndexRead | Access::eVertexAttributeRead);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, kit_->layout(), 0, *slots_[slot].frame_set,
                                {});
    record_shadows(commands, slot);
    record_picture(commands, target, slot);
}

void SceneDrawing::bind_cloth(ClothDrawing& cloth, ClothSlot& slot, const ClothFrame& frame,
                              const ClothExtras& extras, OverlaySet overlays, float blend) const
{
    DeviceClothBuffers nodes;
    vk::Buffer before;
    if (const auto* host = std::get_if<HostCloth>(&frame)) {
        upload(cloth, slot, *host);
        nodes = {*slot.positions, *slot.normals, *slot.strains, cloth.node_count};
        before = host->before.empty() ? *slot.positions : *slot.before;
    } else {
        nodes = std::get<DeviceClothBuffers>(frame);
        if (nodes.node_count != cloth.node_count)
            refuse("a picture of a cloth of " + std::to_string(cloth.node_count) +
                   " nodes was given buffers of " + std::to_string(nodes.node_count));
        before = blend < 1 && cloth.kept.size > 0 ? *cloth.kept : nodes.position;
    }
    take_extras(cloth, slot, extras);
    const auto or_nothing = [&](const Buffer& buffer, bool wanted) {
        return wanted && buffer.size > 0 ? *buffer : *nothing_;
    };
    const bool own_values = !extras.values.empty() && !overlays.has(Overlay::strain);
    const std::array<vk::Buffer, cloth_binding_count> wanted{nodes.position,
                                                             nodes.normal,
                                                             own_values ? *slot.values : nodes.strain,
                                                             *cloth.pattern,
                                                             before,
                                                             or_nothing(cloth.lines, true),
                                                             or_nothing(slot.points, slot.point_count > 0),
                                                             or_nothing(slot.forces, !extras.forces.empty())};
    if (wanted == slot.bound) return;
    slot.bound = wanted;
    std::array<vk::DescriptorBufferInfo, cloth_binding_count> infos;
    for (std::size_t k = 0; k < infos.size(); ++k)
        infos[k] = vk::DescriptorBufferInfo(wanted[k], 0, VK_WHOLE_SIZE);
    device_->handle().updateDescriptorSets(
        vk::WriteDescriptorSet(*slot.set, 0, 0, vk::DescriptorType::eStorageBuffer, {}, infos), {});
}

void SceneDrawing::upload(const ClothDrawing& cloth, ClothSlot& slot, const HostCloth& frame) const
{
    const auto matches = [&](std::size_t size) { return size == cloth.node_count; };
    if (!matches(frame.positions.size()) || !matches(frame.normals.size()) ||
        (!frame.strains.empty() && !matches(frame.strains.size())) ||
        (!frame.before.empty() && !matches(frame.before.size())))
        refuse("a picture of a cloth of " + std::to_string(cloth.node_count) + " nodes was given " +
               std::to_string(frame.positions.size()) + " positions, " +
               std::to_string(frame.normals.size()) + " normals and " + std::to_string(frame.strains.size()) +
               " strains");
    const auto make = [&](Buffer& buffer, std::size_t size, const char* name) {
        if (buffer.size == 0)
            buffer =
                device_->make_buffer(size * cloth.node_count, Usage::eStorageBuffer, Memory::upload, name);
    };
    make(slot.positions, 4 * sizeof(float), "uploaded positions");
    make(slot.normals, 4 * sizeof(float), "uploaded normals");
    make(slot.strains, sizeof(float), "uploaded strains");
    copy_nodes(frame.positions, slot.positions);
    copy_nodes(frame.normals, slot.normals);
    if (frame.strains.empty())
        std::memset(slot.strains.mapped, 0, cloth.node_count * sizeof(float));
    else
        std::memcpy(slot.strains.mapped, frame.strains.data(), frame.strains.size_bytes());
    if (frame.before.empty()) return;
    make(slot.before, 4 * sizeof(float), "uploaded positions before");
    copy_nodes(frame.before, slot.before);
}

void SceneDrawing::take_extras(const ClothDrawing& cloth, ClothSlot& slot, const ClothExtras& extras) const
{
    const auto take = [&](Buffer& buffer, std::span<const float> numbers, const char* name) {
        if (numbers.empty()) return;
        if (numbers.size() != cloth.node_count)
            refuse("a picture of a cloth of " + std::to_string(cloth.node_count) + " nodes was given " +
                   std::to_string(numbers.size()) + " values of an overlay");
        if (buffer.size == 0)
            buffer = device_->make_buffer(numbers.size_bytes(), Usage::eStorageBuffer, Memory::upload, name);
        std::memcpy(buffer.mapped, numbers.data(), numbers.size_bytes());
    };
    take(slot.values, extras.values, "overlay values");
    take(slot.forces, extras.forces, "overlay forces");
    slot.point_count =
        static_cast<std::uint32_t>(std::min<std::size_t>(extras.contacts.size(), cloth.node_count));
    if (slot.point_count == 0) return;
    static_assert(sizeof(ContactPoint) == 4 * sizeof(float));
    if (slot.points.size == 0)  // as many as there can be, so that it need not grow
        slot.points = device_->make_buffer(sizeof(ContactPoint) * cloth.node_count, Usage::eStorageBuffer,
                                           Memory::upload, "contact points");
    std::memcpy(slot.points.mapped, extras.contacts.data(), slot.point_count * sizeof(ContactPoint));
}

void SceneDrawing::bind(const vk::raii::CommandBuffer& commands, Drawn drawn) const
{
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, kit_->pipeline(drawn));
}

void SceneDrawing::bind_set(const vk::raii::CommandBuffer& commands, const ClothSlot& slot) const
{
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, kit_->layout(), 1, *slot.set, {});
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
    // Attachments: colours (covered by the backdrop, not cleared), depth.
    const std::array<vk::ClearValue, 2> clear{vk::ClearColorValue{}, vk::ClearDepthStencilValue(1.0f, 0)};
    const vk::Rect2D area({}, target.size);
    commands.beginRenderPass(vk::RenderPassBeginInfo(target.pass, target.framebuffer, area, clear),
                             vk::SubpassContents::eInline);
    commands.setViewport(0, vk::Viewport(0, 0, static_cast<float>(target.size.width),
                                         static_cast<float>(target.size.height), 0, 1));
    commands.setScissor(0, area);

    // From the front to the back, so that what is hidden costs no shading.
    bind(commands, Drawn::cloth);
    draw_cloths(commands, slot);
    bind(commands, Drawn::shape);
    draw_shapes(commands, slot);
    bind(commands, Drawn::ground);
    draw_floors(commands, slot);
    bind(commands, Drawn::backdrop);
    commands.draw(3, 1, 0, 0);
    draw_overlays(commands, target.size, slot);
}

void SceneDrawing::draw_overlays(const vk::raii::CommandBuffer& commands, vk::Extent2D size,
                                 unsigned slot) const
{
    const OverlaySet shown = slots_[slot].overlays;
    if (shown.has(Overlay::wireframe) && kit_->pipeline(Drawn::wires)) {
        bind(commands, Drawn::wires);
        draw_cloths(commands, slot);
    }
    const auto draw_lines = [&](std::uint32_t kind, float length) {
        push(commands, LineStyle{kind, length});
        for (const ClothDrawing& cloth : cloths_) {
            bind_set(commands, cloth.slots[slot]);
            commands.draw(2 * (kind == 2 ? cloth.node_count : cloth.line_count), 1, 0, 0);
        }
    };
    if (shown.has_lines() || shown.has(Overlay::normals)) bind(commands, Drawn::lines);
    if (shown.has(Overlay::springs)) draw_lines(0, 0);
    if (shown.has(Overlay::active)) draw_lines(1, 0);
    if (shown.has(Overlay::normals)) draw_lines(2, static_cast<float>(0.02 * stage_.view_distance));
    if (shown.has(Overlay::contacts)) {
        bind(commands, Drawn::points);
        for (const ClothDrawing& cloth : cloths_) {
            bind_set(commands, cloth.slots[slot]);
            commands.draw(6 * cloth.slots[slot].point_count, 1, 0, 0);
        }
    }
    if (has_colours(shown) && size.width >= legend_least.width && size.height >= legend_least.height) {
        bind(commands, Drawn::legend);
        push(commands, slots_[slot].legend);
        commands.draw(4, 1, 0, 0);
    }
}

void SceneDrawing::draw_cloths(const vk::raii::CommandBuffer& commands, unsigned slot) const
{
    for (const ClothDrawing& cloth : cloths_) {
        if (cloth.index_count == 0) continue;
        bind_set(commands, cloth.slots[slot]);
        commands.bindIndexBuffer(*cloth.indices, 0, vk::IndexType::eUint32);
        commands.drawIndexed(cloth.index_count, 1, 0, 0, 0);
    }
}

void SceneDrawing::draw_shapes(const vk::raii::CommandBuffer& commands, unsigned slot) const
{
    commands.bindVertexBuffers(0, kit_->shape_vertices(), vk::DeviceSize{0});
    commands.bindIndexBuffer(kit_->shape_indices(), 0, vk::IndexType::eUint32);
    for (const PlacedCollider& collider : slots_[slot].placed) {
        if (is_ground(collider)) continue;
        push(commands, placement_of(collider, stage_.inset));
        const auto range = mesh_of(collider, kit_->shapes());
        commands.drawIndexed(range.index_count, 1, range.first_index, 0, 0);
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
    commands.pushConstants<Constants>(
        kit_->layout(), vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0, constants);
}

}  // namespace pliant::vulkan
