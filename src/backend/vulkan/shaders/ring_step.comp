#version 460
// One step of a soft body by its springs alone, gathered node by node.
#extension GL_GOOGLE_include_directive : require
#include "ring.glsl"
#include "step.glsl"

layout(local_size_x = 64) in;

// The body of a node: blocks are in order of nodes.
uint body_of(uint node)
{
    uint k = 0u;
    while (true) {
        BodyBlock block = block_at(node_blocks_at, k);
        if (node < block.first + block.count) return block.body;
        ++k;
    }
}

void main()
{
    uint node = gl_GlobalInvocationID.x;
    if (node >= parameters.node_count) return;
    RingSums sums = ring_sums(node);
    precise vec3 force = sums.force;
    if (body_topology[pressure_at] == 0u) {
        finish_step(node, force);
        return;
    }
    if (parameters.has_air != 0u) force = force + external_force[node].xyz;
    force = force + sums.gradient * goal_of(body_of(node)).y;
    finish_step_of(node, force);
}
