#version 460
// One step of a soft body with springs alone, gathered node by node. A work group has one block, and thus one body.
#extension GL_GOOGLE_include_directive : require
#include "ring.glsl"
#include "step.glsl"

layout(local_size_x = block_group) in;

void main()
{
    BodyBlock block = block_at(node_blocks_at, gl_WorkGroupID.x);
    if (gl_LocalInvocationID.x >= block.count) return;
    uint node = block.first + gl_LocalInvocationID.x;
    RingSums sums = ring_sums(node);
    precise vec3 force = sums.force;
    if (body_topology[pressure_at] == 0u) {
        finish_step(node, force);
        return;
    }
    if (parameters.has_air != 0u) force = force + external_force[node].xyz;
    force = force + sums.gradient * goal_of(block.body).y;
    finish_step_of(node, force);
}
