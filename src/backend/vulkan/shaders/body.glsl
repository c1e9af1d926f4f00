#ifndef BODY_GLSL
#define BODY_GLSL
// Soft bodies: their topology and their data by node, as body_buffers.cpp lays them out.
#include "cloth.glsl"

layout(set = 0, binding = binding_body_topology, std430) readonly buffer BodyTopology { uint body_topology[]; };

// Where lists begin in body_topology, and in body_sums (in vec4).
const uint node_blocks_at = 0u, fan_blocks_at = 1u, parts_at = 2u, ring_start_at = 3u, ring_at = 4u, fan_start_at = 5u,
           fans_at = 6u, weights_at = 7u, loads_at = 8u, load_count_at = 9u, rate_sums_at = 10u, cubic_sums_at = 11u,
           records_at = 12u, volumes_at = 13u, pressure_at = 14u;

struct BodyBlock
{
    uint first, count, body;
};
BodyBlock block_at(uint blocks, uint k)
{
    uint at = body_topology[blocks] + 3u * k;
    return BodyBlock(body_topology[at], body_topology[at + 1u], body_topology[at + 2u]);
}

struct BodyPart
{
    uint first_block, block_count, first_fan_block, fan_block_count;
    float inverse_weight, inverse_fans;
};
BodyPart part_at(uint k)
{
    uint at = body_topology[parts_at] + 6u * k;
    return BodyPart(body_topology[at], body_topology[at + 1u], body_topology[at + 2u], body_topology[at + 3u],
                    uintBitsToFloat(body_topology[at + 4u]), uintBitsToFloat(body_topology[at + 5u]));
}

float weight_of(uint node)
{
    uint at = body_topology[weights_at];
    return at == 0u ? 1.0f : uintBitsToFloat(body_topology[at + node]);
}
#endif
