#ifndef MEASURE_GLSL
#define MEASURE_GLSL
// Merges blocks of 256 measures in the fixed tree of all backends, by adding halves until one value is left.
#include "cloth.glsl"

layout(set = 0, binding = binding_measures, std430) buffer Measures { vec4 measures[]; };  // two per value
shared Measure block_values[256];

Measure stored_measure(uint at)
{
    vec4 a = measures[2u * at], b = measures[2u * at + 1u];
    Measure m;
    m.max_stretch = a.x;
    m.max_penetration = a.y;
    m.max_speed2 = a.z;
    m.stretch_sum = a.w;
    m.kinetic_energy = b.x;
    m.elastic_energy = b.y;
    m.height_moment = b.z;
    m.non_finite = b.w;
    return m;
}

void merge_block(Measure m, uint target)
{
    uint k = gl_LocalInvocationID.x;
    block_values[k] = m;
    for (uint span = 128u; span > 0u; span /= 2u) {
        barrier();
        if (k < span) block_values[k] = measure_merge(block_values[k], block_values[k + span]);
    }
    if (k == 0u) {
        Measure whole = block_values[0];
        measures[2u * target] = vec4(whole.max_stretch, whole.max_penetration, whole.max_speed2, whole.stretch_sum);
        measures[2u * target + 1u] =
            vec4(whole.kinetic_energy, whole.elastic_energy, whole.height_moment, whole.non_finite);
    }
}
#endif
