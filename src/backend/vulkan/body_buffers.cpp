#include "backend/vulkan/body_buffers.hpp"

#include <bit>
#include <cstring>

#include "backend/vulkan/layout.hpp"

namespace pliant::vulkan {
namespace {

using Usage = vk::BufferUsageFlagBits;

std::uint32_t bits(double a) { return std::bit_cast<std::uint32_t>(static_cast<float>(a)); }

}  // namespace

BodyBuffers::BodyBuffers(const Device& device, const ClothModel& model)
    : body_(model.body ? &*model.body : nullptr)
{
    if (!body_) return;
    const BodyModel& body = *body_;
    const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
    rate_sums_ = {0, 2 * size(body.node_blocks)};
    cubic_sums_ = {rate_sums_.count, 2 * size(body.fan_blocks)};
    records_ = {cubic_sums_.first + cubic_sums_.count, size(body.parts)};
    volumes_ = {records_.first + records_.count, size(body.parts)};

    // As in shaders/body.glsl: first the beginnings of the lists, then the lists.
    std::vector<std::uint32_t> t(16, 0);
    const auto begin = [&](std::size_t list) { t[list] = static_cast<std::uint32_t>(t.size()); };
    const auto push = [&](auto... numbers) { (t.push_back(numbers), ...); };
    begin(0);
    for (const BodyBlock& block : body.node_blocks) push(block.first, block.count, block.body);
    begin(1);
    for (const BodyBlock& block : body.fan_blocks) push(block.first, block.count, block.body);
    begin(2);
    for (const BodyPart& part : body.parts)
        push(part.first_block, part.block_count, part.first_fan_block, part.fan_block_count,
             bits(part.inverse_weight), bits(part.inverse_fans));
    begin(3);
    for (std::size_t i = 0; i < model.node_count(); ++i)
        push(model.springs.neighbours.start[i], body.links[i]);
    push(model.springs.neighbours.start.back());
    begin(4);
    for (const Neighbour& n : model.springs.neighbours.entries)
        push(n.node, bits(model.springs.list[n.spring].rest_length));
    begin(5);
    for (const std::uint32_t start : body.fans.start) push(start);
    begin(6);
    for (const std::uint32_t node : body.fans.entries) push(node);
    if (!body.weights.empty()) begin(7);
    for (const float weight : body.weights) push(bits(double{weight}));
    begin(8);
    for (const LoadedNode& load : body.loads)
        push(load.node, bits(load.force.x), bits(load.force.y), bits(load.force.z), bits(load.torque.x),
             bits(load.torque.y), bits(load.torque.z));
    t[9] = size(body.loads);
    t[10] = rate_sums_.first;
    t[11] = cubic_sums_.first;
    t[12] = records_.first;
    t[13] = volumes_.first;
    t[14] = body.has_pressure ? 1 : 0;
    const auto filled = [&](const void* data, std::size_t bytes, const char* name) {
        Buffer buffer =
            device.make_buffer(bytes, Usage::eStorageBuffer | Usage::eTransferSrc, Memory::device, name);
        device.write(buffer, data, bytes);
        return buffer;
    };
    topology_ = filled(t.data(), t.size() * sizeof t[0], "body topology");
    const std::vector<Float4> nothing(model.node_count());
    const std::size_t node_bytes = nothing.size() * sizeof(Float4);
    gradient_ = filled(nothing.data(), node_bytes, "volume gradient");
    direction_ = filled(nothing.data(), node_bytes, "volume direction");
    blocked_ = filled(nothing.data(), node_bytes, "blocked nodes");
    std::vector<Float4> sums(volumes_.first + volumes_.count);
    for (std::size_t k = 0; k < body.parts.size(); ++k) {
        const Vec3 c = to_float(body.parts[k].centre);
        sums[records_.first + k] = {c.x, c.y, c.z, static_cast<float>(6 * body.parts[k].volume)};
    }
    sums_ = filled(sums.data(), sums.size() * sizeof(Float4), "body sums");
    read_volumes_ = device.make_buffer(volumes_.count * sizeof(Float4), Usage::eTransferDst, Memory::readback,
                                       "measured volumes");
}

std::uint32_t BodyBuffers::groups_of(const Call& call) const
{
    const auto groups = [](std::size_t n) {
        return static_cast<std::uint32_t>((n + linear_group - 1) / linear_group);
    };
    switch (unit_of(call.pass)) {
        case PassUnit::load: return groups(body_->loads.size());
        case PassUnit::fan_block: return static_cast<std::uint32_t>(body_->fan_blocks.size());
        case PassUnit::body: return static_cast<std::uint32_t>(body_->parts.size());
        default: return static_cast<std::uint32_t>(body_->node_blocks.size());
    }
}

void BodyBuffers::record_volume_copy(const vk::raii::CommandBuffer& commands) const
{
    commands.copyBuffer(*sums_, *read_volumes_,
                        vk::BufferCopy(volumes_.first * sizeof(Float4), 0, volumes_.count * sizeof(Float4)));
}

double BodyBuffers::volume(std::size_t body) const
{
    return double{static_cast<const Float4*>(read_volumes_.mapped)[body].x};
}

BodyBuffers::Rows BodyBuffers::rows_of(Resource resource) const
{
    switch (resource) {
        case Resource::rate_sums: return rate_sums_;
        case Resource::cubic_sums: return cubic_sums_;
        case Resource::bodies: return records_;
        case Resource::volumes: return volumes_;
        default: return {};
    }
}

}  // namespace pliant::vulkan
