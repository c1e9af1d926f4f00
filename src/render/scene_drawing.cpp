#include "render/scene_drawing.hpp"

#include <bit>
#include <cstring>
#include <numeric>

#include "render/cloth_pattern.hpp"

namespace pliant::vulkan {
namespace {

using Usage = vk::BufferUsageFlagBits;

constexpr std::uint32_t floats_uploaded = 3, floats_on_device = 4;  // per node

/// Lists of pairs, one list per node, in the layout of the shaders: first the beginnings, then all pairs.
class PairLists {
public:
    explicit PairLists(std::uint32_t node_count) : begins_(node_count + 1, 0) {}
    void add(std::uint32_t node, std::uint32_t first, std::uint32_t second)
    {
        pairs_.push_back({node, first, second});
        begins_[node + 1] += 2;
    }
    std::vector<std::uint32_t> packed() const
    {
        std::vector<std::uint32_t> all(begins_.size() + 2 * pairs_.size());
        std::partial_sum(begins_.begin(), begins_.end(), all.begin());
        for (std::size_t k = 0; k < begins_.size(); ++k) all[k] += static_cast<std::uint32_t>(begins_.size());
        std::vector<std::uint32_t> next(all.begin(), all.begin() + static_cast<long>(begins_.size()));
        for (const auto& [node, first, second] : pairs_) {
            all[next[node]++] = first;
            all[next[node]++] = second;
        }
        return all;
    }

private:
    std::vector<std::uint32_t> begins_;
    std::vector<std::array<std::uint32_t, 3>> pairs_;
};

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
        {vk::DescriptorType::eStorageBuffer,
         slots * static_cast<std::uint32_t>(drawn_bindings.size() + surface_bindings.size()) *
             std::max(1u, cloths)}};
    pool_ = {device_->handle(),
             {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, slots * (1 + 2 * cloths), sizes}};
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
    const std::uint32_t groups =
                            (topology.node_count + PictureKit::surface_group - 1) / PictureKit::surface_group,
                        most = device_->physical().getProperties().limits.maxComputeWorkGroupCount[0];
    if (groups > most)
        throw Error(ErrorKind::device_failure,
                    "a cloth of " + std::to_string(topology.node_count) + " nodes cannot be drawn on " +
                        device_->info().name + ": its limit maxComputeWorkGroupCount[0] is " +
                        std::to_string(most) + ", and " + std::to_string(groups) + " is needed");
    ClothDrawing drawing;
    drawing.node_count = topology.node_count;
    drawing.rows = topology.rows;
    drawing.columns = topology.columns;
    drawing.index_count = static_cast<std::uint32_t>(3 * topology.triangles.size());
    drawing.indices = device_->make_buffer(topology.triangles.size_bytes(), Usage::eIndexBuffer,
                                           Memory::device, "cloth triangles");
    device_->write(drawing.indices, topology.triangles.data(), topology.triangles.size_bytes());
    const auto pattern = cloth_pattern(cloth, topology.rows, topology.columns, topology.node_count);
    const std::size_t pattern_bytes = pattern.size() * sizeof(pattern.front());
    drawing.pattern =
        device_->make_buffer(pattern_bytes, Usage::eStorageBuffer, Memory::device, "cloth pattern");
    device_->write(drawing.pattern, pattern.data(), pattern_bytes);
    const auto make = [&](std::size_t floats, const char* name) {
        return device_->make_buffer(floats * sizeof(float) * topology.node_count, Usage::eStorageBuffer,
                                    Memory::device, name);
    };
    drawing.positions = make(4, "seen positions");
    drawing.normals = make(4, "seen normals");
    drawing.strains = make(1, "seen strains");
    const std::vector<float> no_strains(topology.node_count, 0.0f);
    device_->write(drawing.strains, no_strains.data(), no_strains.size() * sizeof(float));
    if (const auto edges = edges_of(topology.triangles); !edges.empty()) {
        drawing.edges = make_filled(edges, "cloth edges");
        drawing.edge_count = static_cast<std::uint32_t>(edges.size());
    }
    if (topology.columns == 0) {
        PairLists ring(topology.node_count);
        for (const Triangle& t : topology.triangles)
            for (std::size_t k = 0; k < 3; ++k) ring.add(t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
        drawing.ring = make_filled(ring.packed(), "triangles around nodes");
    }
    const vk::DescriptorSetLayout layouts[] = {kit_->drawn_set(), kit_->surface_set()};
    for (unsigned k = 0; k < slots; ++k) {
        vk::raii::DescriptorSets sets(device_->handle(), {*pool_, layouts});
        ClothSlot& slot = drawing.slots.emplace_back();
        slot.drawn_set = std::move(sets.front());
        slot.surface_set = std::move(sets.back());
    }
    return drawing;
}

template <class T>
Buffer SceneDrawing::make_filled(const std::vector<T>& values, const char* name) const
{
    Buffer buffer =
        device_->make_buffer(values.size() * sizeof(T), Usage::eStorageBuffer, Memory::device, name);
    device_->write(buffer, values.data(), values.size() * sizeof(T));
    return buffer;
}

void SceneDrawing::set_springs(std::size_t cloth, std::span<const DrawnSpring> springs)
{
    ClothDrawing& drawing = cloths_.at(cloth);
    std::vector<std::array<std::uint32_t, 2>> lines;
    PairLists neighbours(drawing.node_count);
    for (const DrawnSpring& spring : springs) {
        lines.push_back({spring.i, spring.j | static_cast<std::uint32_t>(spring.kind) << 30});
        if (spring.kind == SpringKind::bend) continue;
        const auto rest = std::bit_cast<std::uint32_t>(spring.rest_length);
        neighbours.add(spring.i, spring.j, rest);
        neighbours.add(spring.j, spring.i, rest);
    }
    drawing.lines = make_filled(lines, "drawn springs");
    drawing.neighbours = make_filled(neighbours.packed(), "springs around nodes");
    drawing.line_count = static_cast<std::uint32_t>(springs.size());
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
                   state.extras.empty() ? ClothExtras{} : state.extras[i]);
    for (std::size_t i = 0; i < colliders_.size(); ++i) slot.placed[i] = placed_at(colliders_[i], state.time);
    FrameUniforms uniforms = frame_uniforms(stage_, state.camera, size.width, size.height, ShadowMap::edge);
    uniforms.value_low = scale.low;
    uniforms.value_high = scale.high;
    uniforms.blend = state.blend;
    if (state.overlays.has_colours()) uniforms.colours = scale.diverging ? 2 : 1;
    std::memcpy(slot.uniforms.mapped, &uniforms, sizeof uniforms);
}

std::optional<PixelArea> SceneDrawing::touched(const PictureState& state, vk::Extent2D size,
                                               unsigned slot) const
{
    TouchedArea touched(stage_, state.camera, size.width, size.height, stage_.shadow_extent / ShadowMap::edge,
                        slots_[slot].placed, kit_->shapes());
    for (const ClothFrame& frame : state.frames) {
        const auto* host = std::get_if<HostCloth>(&frame);
        if (!host || !host->before.empty()) return std::nullopt;
        touched.include(host->positions);
    }
    return touched.area();
}

void SceneDrawing::bind_cloth(const ClothDrawing& cloth, ClothSlot& slot, const ClothFrame& frame,
                              const ClothExtras& extras) const
{
    vk::Buffer now, before;
    if (const auto* host = std::get_if<HostCloth>(&frame)) {
        upload(cloth, slot, *host);
        now = *slot.positions;
        before = host->before.empty() ? now : *slot.before;
        slot.stride = floats_uploaded;
    } else {
        const auto& device = std::get<DeviceCloth>(frame);
        if (device.node_count != cloth.node_count)
            refuse("a picture of a cloth of " + std::to_string(cloth.node_count) +
                   " nodes was given buffers of " + std::to_string(device.node_count));
        now = device.positions;
        before = device.before ? device.before : now;
        slot.stride = floats_on_device;
    }
    take_extras(cloth, slot, extras);
    slot.has_values = !extras.values.empty();
    const auto or_nothing = [&](const Buffer& buffer) { return buffer.size > 0 ? *buffer : *nothing_; };
    const std::array<vk::Buffer, cloth_binding_count> wanted{*cloth.positions,
                                                             *cloth.normals,
                                                             slot.has_values ? *slot.values : *cloth.strains,
                                                             *cloth.pattern,
                                                             before,
                                                             or_nothing(cloth.lines),
                                                             or_nothing(slot.points),
                                                             or_nothing(slot.held),
                                                             now,
                                                             or_nothing(cloth.ring),
                                                             or_nothing(cloth.neighbours),
                                                             or_nothing(cloth.edges)};
    if (wanted == slot.bound) return;
    slot.bound = wanted;
    std::array<vk::DescriptorBufferInfo, cloth_binding_count> infos;
    for (std::size_t k = 0; k < infos.size(); ++k)
        infos[k] = vk::DescriptorBufferInfo(wanted[k], 0, VK_WHOLE_SIZE);
    std::vector<vk::WriteDescriptorSet> writes;
    const auto write = [&](vk::DescriptorSet set, std::span<const std::uint32_t> bindings) {
        for (const std::uint32_t binding : bindings)
            writes.emplace_back(set, binding, 0, 1, vk::DescriptorType::eStorageBuffer, nullptr,
                                &infos[binding]);
    };
    write(*slot.drawn_set, drawn_bindings);
    write(*slot.surface_set, surface_bindings);
    device_->handle().updateDescriptorSets(writes, {});
}

void SceneDrawing::upload(const ClothDrawing& cloth, ClothSlot& slot, const HostCloth& frame) const
{
    const auto take = [&](Buffer& buffer, std::span<const Vec3> positions, const char* name) {
        if (positions.size() != cloth.node_count)
            refuse("a picture of a cloth of " + std::to_string(cloth.node_count) + " nodes was given " +
                   std::to_string(positions.size()) + " positions");
        static_assert(sizeof(Vec3) == floats_uploaded * sizeof(float));
        if (buffer.size == 0)
            buffer =
                device_->make_buffer(positions.size_bytes(), Usage::eStorageBuffer, Memory::upload, name);
        std::memcpy(buffer.mapped, positions.data(), positions.size_bytes());
    };
    take(slot.positions, frame.positions, "uploaded positions");
    if (!frame.before.empty()) take(slot.before, frame.before, "uploaded positions before");
}

void SceneDrawing::take_extras(const ClothDrawing& cloth, ClothSlot& slot, const ClothExtras& extras) const
{
    const auto take = [&](Buffer& buffer, auto numbers, std::size_t count, const char* name) {
        if (numbers.empty()) return;
        if (numbers.size() != count)
            refuse("a picture of a cloth was given " + std::to_string(numbers.size()) +
                   " values of an overlay instead of " + std::to_string(count));
        if (buffer.size < numbers.size_bytes())
            buffer = device_->make_buffer(numbers.size_bytes(), Usage::eStorageBuffer, Memory::upload, name);
        std::memcpy(buffer.mapped, numbers.data(), numbers.size_bytes());
    };
    take(slot.values, extras.values, cloth.node_count, "overlay values");
    take(slot.held, extras.held, cloth.line_count, "held springs");
    slot.has_held = !extras.held.empty();
    slot.point_count =
        static_cast<std::uint32_t>(std::min<std::size_t>(extras.contacts.size(), cloth.node_count));
    if (slot.point_count == 0) return;
    static_assert(sizeof(ContactPoint) == 4 * sizeof(float));
    if (slot.points.size == 0)  // the maximum number, so that it never grows
        slot.points = device_->make_buffer(sizeof(ContactPoint) * cloth.node_count, Usage::eStorageBuffer,
                                           Memory::upload, "contact points");
    std::memcpy(slot.points.mapped, extras.contacts.data(), slot.point_count * sizeof(ContactPoint));
}

}  // namespace pliant::vulkan
