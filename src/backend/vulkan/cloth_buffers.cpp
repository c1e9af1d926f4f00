#include "backend/vulkan/cloth_buffers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "backend/vulkan/layout.hpp"

namespace pliant::vulkan {
namespace {

using Usage = vk::BufferUsageFlagBits;

vk::DescriptorType type_of(Binding binding)
{
    return is_uniform(binding) ? vk::DescriptorType::eUniformBuffer : vk::DescriptorType::eStorageBuffer;
}

Float4 float4(Vector3<float> a, float w = 0) { return {a.x, a.y, a.z, w}; }
Float4 float4(Vec3 a, float w) { return {a.x, a.y, a.z, w}; }

}  // namespace

vk::raii::DescriptorSetLayout make_cloth_layout(const Device& device, PassLayout layout)
{
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const Binding binding : bindings_of(layout))
        bindings.emplace_back(static_cast<std::uint32_t>(binding), type_of(binding), 1,
                              vk::ShaderStageFlagBits::eCompute);
    return {device.handle(), vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

bool ClothBuffers::takes(PassLayout layout) const
{
    switch (layout) {
        case PassLayout::nodes: return true;
        case PassLayout::springs:
        case PassLayout::list_steps: return !model_->plan.node_centric;
        case PassLayout::triangles: return !model_->plan.on_grid;
        case PassLayout::body_forces:
        case PassLayout::body_volume: return model_->plan.is_body();
        case PassLayout::solver:
        case PassLayout::solver_ends: return !model_->hierarchy.empty();
    }
    return false;
}

void ClothBuffers::make_sets(const Device& device, std::span<const vk::raii::DescriptorSetLayout> layouts)
{
    std::uint32_t storage = 0, uniform = 0, count = 0;
    for (std::uint32_t f = 0; f < layout_count; ++f) {
        const auto layout = static_cast<PassLayout>(f);
        if (!takes(layout)) continue;
        count += 2;
        for (const Binding binding : bindings_of(layout)) (is_uniform(binding) ? uniform : storage) += 2;
    }
    const vk::DescriptorPoolSize sizes[] = {{vk::DescriptorType::eUniformBuffer, uniform},
                                            {vk::DescriptorType::eStorageBuffer, storage}};
    pool_ = {device.handle(), vk::DescriptorPoolCreateInfo(
                                  vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, count, sizes)};
    for (std::uint32_t f = 0; f < layout_count; ++f) {
        if (!takes(static_cast<PassLayout>(f))) continue;
        const vk::DescriptorSetLayout both[] = {*layouts[f], *layouts[f]};
        for (auto& set :
             vk::raii::DescriptorSets(device.handle(), vk::DescriptorSetAllocateInfo(*pool_, both)))
            sets_[f].push_back(std::move(set));
    }
}

void ClothBuffers::write(const Device& device, std::span<const Vec3> positions,
                         std::span<const Vec3> velocities)
{
    std::vector<Float4> values(positions.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = float4(positions[i], static_cast<float>(model_->masses.inverse(i)));
    for (const Buffer& buffer : position_)
        device.write(buffer, values.data(), values.size() * sizeof(Float4));
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = float4(velocities[i], static_cast<float>(model_->masses.kg[i]));
    for (const Buffer& buffer : velocity_)
        device.write(buffer, values.data(), values.size() * sizeof(Float4));
}

void ClothBuffers::take_mass(const Device& device, std::uint32_t node)
{
    const float mass = static_cast<float>(model_->masses.kg[node]),
                inverse = static_cast<float>(model_->masses.inverse(node));
    const std::size_t at = node * sizeof(Float4) + offsetof(Float4, w);
    for (const Buffer& buffer : position_) device.write(buffer, &inverse, sizeof inverse, at);
    for (const Buffer& buffer : velocity_) device.write(buffer, &mass, sizeof mass, at);
}

std::vector<ClothBuffers::KeptPiece> ClothBuffers::pieces_of(const Kept& kept) const
{
    std::vector<KeptPiece> pieces;
    vk::DeviceSize place = 0;
    const auto add = [&](const Buffer& buffer, vk::DeviceSize first, vk::DeviceSize size) {
        pieces.push_back({&buffer, first, place, size});
        place += size;
    };
    if (kept.state)
        for (const Buffer* buffer : {&position_[kept.parity], &velocity_[kept.parity]})
            add(*buffer, 0, model_->node_count() * sizeof(Float4));
    for (const ArenaRange& range : kept.numbers)
        add(solver_.arena(), range.first * sizeof(float), range.count * sizeof(float));
    add(solver_.scalars(), 0, solver_scalar_count * sizeof(float));
    return pieces;
}

void ClothBuffers::make_room_for(const Device& device, const Kept& kept)
{
    const KeptPiece last = pieces_of(kept).back();
    if (kept_.size < last.place + last.size)
        kept_ = device.make_buffer(last.place + last.size, {}, Memory::device, "state kept aside");
}

namespace {

void between_copies(const vk::raii::CommandBuffer& commands)
{
    constexpr auto all = vk::AccessFlagBits::eMemoryRead | vk::AccessFlagBits::eMemoryWrite;
    barrier(commands, vk::PipelineStageFlagBits::eAllCommands, all, vk::PipelineStageFlagBits::eAllCommands,
            all);
}

}  // namespace

void ClothBuffers::record_keep(const vk::raii::CommandBuffer& commands, const Kept& kept) const
{
    between_copies(commands);
    for (const KeptPiece& piece : pieces_of(kept))
        commands.copyBuffer(**piece.buffer, *kept_, vk::BufferCopy(piece.first, piece.place, piece.size));
    between_copies(commands);
}

void ClothBuffers::record_put_back(const vk::raii::CommandBuffer& commands, const Kept& kept) const
{
    between_copies(commands);
    for (const KeptPiece& piece : pieces_of(kept))
        commands.copyBuffer(*kept_, **piece.buffer, vk::BufferCopy(piece.place, piece.first, piece.size));
    between_copies(commands);
}

Buffer ClothBuffers::filled(const Device& device, const void* data, std::size_t bytes, const char* name) const
{
    Buffer buffer = device.make_buffer(bytes, Usage::eStorageBuffer, Memory::device, name);
    device.write(buffer, data, bytes);
    return buffer;
}

ClothBuffers::ClothBuffers(const Device& device, const ClothModel& model,
                           std::span<const vk::raii::DescriptorSetLayout> layouts)
    : model_(&model), tree_(model.node_count()), solver_(device, model), body_(device, model)
{
    const std::size_t nodes = model.node_count();
    std::vector<Float4> values(nodes);
    const auto node_buffer = [&](const char* name) {
        return filled(device, values.data(), nodes * sizeof(Float4), name);
    };
    for (std::size_t i = 0; i < nodes; ++i)
        values[i] = float4(model.shape.positions[i], static_cast<float>(model.masses.inverse(i)));
    for (auto& buffer : position_) buffer = node_buffer("position");
    for (std::size_t i = 0; i < nodes; ++i)
        values[i] = float4(model.shape.velocities[i], static_cast<float>(model.masses.kg[i]));
    for (auto& buffer : velocity_) buffer = node_buffer("velocity");

    parameters_ = device.make_buffer(sizeof(Parameters), Usage::eUniformBuffer, Memory::upload, "parameters");
    measures_ = device.make_buffer(tree_.value_count * 2 * sizeof(Float4), Usage::eStorageBuffer,
                                   Memory::device, "measures");
    root_ = device.make_buffer(2 * sizeof(Float4), Usage::eTransferDst, Memory::readback, "measured total");
    if (model.has_external_force()) {
        std::fill(values.begin(), values.end(), Float4{});  // zero at nodes without a region's force
        external_force_ = node_buffer("external force");
    }

    if (!model.plan.node_centric) {
        std::vector<std::array<std::uint32_t, 2>> ends, around;
        std::vector<std::array<float, 4>> rest_class;
        for (const Spring& spring : model.springs.list) {
            ends.push_back({spring.i, spring.j});
            rest_class.push_back({static_cast<float>(spring.rest_length),
                                  static_cast<float>(spring.spring_class), static_cast<float>(spring.scale),
                                  static_cast<float>(spring.bending)});
        }
        for (const Neighbour& neighbour : model.springs.neighbours.entries)
            around.push_back({neighbour.node, neighbour.spring});
        const auto& start = model.springs.neighbours.start;
        springs_ = filled(device, ends.data(), ends.size() * sizeof(ends[0]), "springs");
        spring_rest_class_ =
            filled(device, rest_class.data(), rest_class.size() * sizeof(rest_class[0]), "rest lengths");
        neighbour_start_ = filled(device, start.data(), start.size() * sizeof(start[0]), "neighbour rows");
        neighbours_ = filled(device, around.data(), around.size() * sizeof(around[0]), "neighbours");
        if (model.plan.step == SteppingPlan::Step::stages)
            slopes_ = device.make_buffer(2 * nodes * sizeof(Float4), Usage::eStorageBuffer, Memory::device,
                                         "slopes");
        spring_force_ = device.make_buffer(ends.size() * sizeof(Float4), Usage::eStorageBuffer,
                                           Memory::device, "spring force");
    }
    if (!model.plan.on_grid) {
        const auto triangles = model.shape.triangles();
        const auto &start = model.shape.node_triangles.start, &around = model.shape.node_triangles.entries;
        triangles_ = filled(device, triangles.data(), triangles.size_bytes(), "triangles");
        triangle_start_ = filled(device, start.data(), start.size() * sizeof(start[0]), "triangle rows");
        node_triangles_ =
            filled(device, around.data(), around.size() * sizeof(around[0]), "triangles around nodes");
    }

    make_sets(device, layouts);
    for (std::uint32_t parity = 0; parity < 2; ++parity) {
        const std::pair<Binding, const Buffer*> bound[] = {
            {Binding::parameters, &parameters_},
            {Binding::position_in, &position_[parity]},
            {Binding::velocity_in, &velocity_[parity]},
            {Binding::position_out, &position_[1 - parity]},
            {Binding::velocity_out, &velocity_[1 - parity]},
            // Always bound, since the step reads it if there is air.
            {Binding::external_force, model.has_external_force() ? &external_force_ : &measures_},
            {Binding::springs, &springs_},
            {Binding::spring_rest_class, &spring_rest_class_},
            {Binding::neighbour_start, &neighbour_start_},
            {Binding::neighbours, &neighbours_},
            {Binding::triangles, &triangles_},
            {Binding::triangle_start, &triangle_start_},
            {Binding::node_triangles, &node_triangles_},
            {Binding::spring_force, &spring_force_},
            {Binding::measures, &measures_},
            {Binding::solver, &solver_.constants()},
            {Binding::solver_arena, &solver_.arena()},
            {Binding::solver_scalars, &solver_.scalars()},
            {Binding::solver_parts, &solver_.parts()},
            {Binding::solver_topology, &solver_.topology()},
            {Binding::multiplier, &solver_.multiplier()},
            {Binding::body_topology, &body_.topology()},
            {Binding::gradient, &body_.gradient()},
            {Binding::direction, &body_.direction()},
            {Binding::blocked, &body_.blocked()},
            {Binding::body_sums, &body_.sums()},
            {Binding::slopes, &slopes_},
        };
        for (const auto& [binding, buffer] : bound)
            if (buffer->size > 0) bind(device, parity, binding, *buffer);  // else unused by this cloth
    }
}

void ClothBuffers::bind(const Device& device, std::uint32_t parity, Binding binding, const Buffer& buffer)
{
    const auto descriptor = buffer.descriptor();
    for (std::uint32_t f = 0; f < layout_count; ++f) {
        const auto bindings = bindings_of(static_cast<PassLayout>(f));
        if (sets_[f].empty() || std::find(bindings.begin(), bindings.end(), binding) == bindings.end())
            continue;
        device.handle().updateDescriptorSets(
            vk::WriteDescriptorSet(*sets_[f][parity], static_cast<std::uint32_t>(binding), 0, 1,
                                   type_of(binding), nullptr, &descriptor),
            {});
    }
}

bool ClothBuffers::make_room_for(const Device& device, Pass pass)
{
    const bool normal = pass == Pass::sheet_normal || pass == Pass::mesh_normal;
    const bool strain = pass == Pass::sheet_strain || pass == Pass::list_strain;
    if (!normal && !strain) return false;
    Buffer& buffer = normal ? normal_ : strain_;
    if (buffer.size > 0) return false;
    const std::size_t bytes = model_->node_count() * (normal ? sizeof(Float4) : sizeof(float));
    buffer = device.make_buffer(bytes, Usage::eStorageBuffer, Memory::device, normal ? "normal" : "strain");
    for (std::uint32_t parity = 0; parity < 2; ++parity)
        bind(device, parity, normal ? Binding::normal : Binding::strain, buffer);
    return true;
}

void ClothBuffers::bind_colliders(const Device& device, const Buffer& colliders)
{
    for (std::uint32_t parity = 0; parity < 2; ++parity) bind(device, parity, Binding::colliders, colliders);
}

void ClothBuffers::set_parameters(double step_length, std::uint32_t collider_count, bool colliders_rest,
                                  const FrameRows& rows, const GrabInput& grab)
{
    StepConstants<float> c(*model_, step_length);
    c.set(grab);
    Parameters p{};
    if (model_->shape.sheet) {
        p.rows = model_->shape.sheet->rows;
        p.columns = model_->shape.sheet->columns;
    }
    p.node_count = model_->node_count();
    p.spring_count = static_cast<std::uint32_t>(model_->springs.list.size());
    p.collider_count = collider_count;
    p.colliders_rest = colliders_rest ? 1 : 0;
    p.has_air = model_->has_external_force() ? 1 : 0;
    p.gravity_dt = float4(c.gravity, c.dt);
    p.gravity_direction = float4(c.gravity_direction, c.decay);
    p.wind_density = float4(c.wind, c.air_density);
    p.drag_lift_thickness = {c.drag, c.lift, c.thickness, 0};
    p.stiffness = {c.stiffness[0], c.stiffness[1], c.stiffness[2], 0};
    p.spring_damping = {c.damping[0], c.damping[1], c.damping[2], 0};
    p.rest_lengths = {c.rest_lengths[0], c.rest_lengths[1], c.rest_lengths[2], c.rest_lengths[3]};
    p.attached_first = rows.attached;
    p.colliders_first = rows.colliders;
    p.goals_first = rows.goals;
    p.goals_stride = rows.goals_stride;
    p.rest_lengths_more.x = c.rest_lengths[4];
    p.rest_lengths_more.y = step_length > 0 ? 1 / c.dt : 0;
    p.rest_lengths_more.z = c.grab_hold;
    p.grabbed_node = c.grabbed_node;
    p.grab_target = float4(c.grab_target, c.grab_pull);
    std::memcpy(parameters_.mapped, &p, sizeof p);
    solver_.set_constants(step_length);
}

const Buffer& ClothBuffers::buffer(Resource resource, std::uint32_t parity) const
{
    switch (resource) {
        case Resource::position: return position_[parity];
        case Resource::velocity: return velocity_[parity];
        case Resource::next_position: return position_[1 - parity];
        case Resource::next_velocity: return velocity_[1 - parity];
        case Resource::external_force: return external_force_;
        case Resource::spring_force: return spring_force_;
        case Resource::normal: return normal_;
        case Resource::strain: return strain_;
        case Resource::slopes: return slopes_;
        case Resource::measures: return measures_;
        case Resource::multiplier: return solver_.multiplier();
        case Resource::gradient: return body_.gradient();
        case Resource::direction: return body_.direction();
        case Resource::blocked: return body_.blocked();
        case Resource::rate_sums:
        case Resource::cubic_sums:
        case Resource::bodies:
        case Resource::volumes: return body_.sums();
        case Resource::colliders:
        case Resource::motion:
        case Resource::vectors:
        case Resource::blocks:
        case Resource::flags:
        case Resource::scalars:
        case Resource::sums: break;  // see SolverBuffers
    }
    throw Error(ErrorKind::bad_usage, "this resource is not a cloth's");
}

std::size_t ClothBuffers::entry_count(Resource resource) const
{
    if (resource == Resource::spring_force) return model_->springs.list.size();
    return resource == Resource::measures ? tree_.value_count : model_->node_count();
}

void ClothBuffers::record_root_copy(const vk::raii::CommandBuffer& commands) const
{
    commands.copyBuffer(
        *measures_, *root_,
        vk::BufferCopy(tree_.levels.back().first * 2 * sizeof(Float4), 0, 2 * sizeof(Float4)));
}

MeasureTotals ClothBuffers::totals() const
{
    Float4 root[2];
    std::memcpy(root, root_.mapped, sizeof root);
    return {root[0].x, root[0].y, root[0].z, root[0].w, root[1].x, root[1].y, root[1].z, root[1].w};
}

}  // namespace pliant::vulkan
