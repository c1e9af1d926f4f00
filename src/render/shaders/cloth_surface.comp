#version 460
// The data of each node for a picture: its position between two states, the normal there, and the largest strain. The
// simulation stores none of these, and the host does not compute them.
#extension GL_GOOGLE_include_directive : require
#include "laws.glsl"
#define SURFACE_ACCESS
#include "frame.glsl"
#include "cloth_nodes.glsl"

layout(local_size_x = 64) in;
// `SurfaceStyle` in render/scene_drawing.cpp.
layout(push_constant) uniform Style {
    uint node_count;
    uint rows, columns;         // of a sheet; 0 for a mesh, whose triangles `ring` has
    uint stride;                // floats of a node in `now` and in `before`
    uint strain;                // 1: values are needed
} style;

vec3 place_of(uint node)
{
    uint at = style.stride * node;
    vec3 last = vec3(now[at], now[at + 1u], now[at + 2u]);
    if (frame.blend >= 1.0f) return last;  // the previous state is ignored, even if infinite
    return mix(vec3(before[at], before[at + 1u], before[at + 2u]), last, frame.blend);
}

vec3 quadrant(vec3 x, ivec2 at, ivec2 first, ivec2 second)
{
    ivec2 size = ivec2(style.rows, style.columns), corner = at + first + second;
    if (any(lessThan(corner, ivec2(0))) || any(greaterThanEqual(corner, size))) return vec3(0.0f);
    ivec2 a = at + first, b = at + second;
    return quadrant_normal(x, place_of(uint(a.x * size.y + a.y)), place_of(uint(corner.x * size.y + corner.y)),
                           place_of(uint(b.x * size.y + b.y)));
}

// Algorithm 5 of the cloth paper, as in the passes sheet_normal and mesh_normal.
vec3 normal_of(uint node, vec3 x)
{
    vec3 sum = vec3(0.0f);
    if (style.columns > 0u) {
        ivec2 at = ivec2(node / style.columns, node % style.columns);
        sum = sum + quadrant(x, at, ivec2(1, 0), ivec2(0, 1));
        sum = sum + quadrant(x, at, ivec2(0, 1), ivec2(-1, 0));
        sum = sum + quadrant(x, at, ivec2(-1, 0), ivec2(0, -1));
        sum = sum + quadrant(x, at, ivec2(0, -1), ivec2(1, 0));
        return sum;
    }
    for (uint e = ring[node]; e < ring[node + 1u]; e += 2u)
        sum = sum + triangle_normal(x, place_of(ring[e]), place_of(ring[e + 1u]));
    return sum;
}

float stretch_of(uint node)
{
    uint at = style.stride * node;
    vec3 x = vec3(now[at], now[at + 1u], now[at + 2u]);
    float most = -1.0f;
    for (uint e = neighbours[node]; e < neighbours[node + 1u]; e += 2u) {
        uint other = style.stride * neighbours[e];
        most = largest(spring_stretch(x, vec3(now[other], now[other + 1u], now[other + 2u]),
                                      uintBitsToFloat(neighbours[e + 1u])), most);
    }
    return most;
}

void main()
{
    uint node = gl_GlobalInvocationID.x;
    if (node >= style.node_count) return;
    vec3 x = place_of(node);
    positions[node] = vec4(x, 0.0f);
    normals[node] = vec4(direction(normal_of(node, x)), 0.0f);
    if (style.strain != 0u) values[node] = stretch_of(node);
}
