#version 460
// Several steps of a sheet in one dispatch. A group loads a tile and its surroundings into shared memory. Every step covers
// two nodes less on each side, until only the tile is left. Each node gets the same bits as in sheet_step.
#extension GL_GOOGLE_include_directive : require
#include "sheet_force.glsl"
#include "step.glsl"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint steps = 2u;      // per dispatch
layout(constant_id = 2) const uint tile_rows = 8u;  // rows of a group's tile; see SheetTile (sheet_tile.hpp)
layout(constant_id = 3) const uint tile_columns = 8u;

const uint reach = 2u;  // of a spring, in nodes
const uint halo = reach * steps;
const uint region_rows = tile_rows + 2u * halo, region_columns = tile_columns + 2u * halo;
const uint region_size = region_rows * region_columns;
const uint most_nodes =  // per invocation in a step
    ((region_rows - 2u * reach) * (region_columns - 2u * reach) + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;

shared float region[7u * region_size];  // planes of position, velocity and inverse mass
ivec2 corner;                           // of the region, on the sheet

vec3 region_vector(uint plane, uint at)
{
    uint first = plane * region_size + at;
    return vec3(region[first], region[first + region_size], region[first + 2u * region_size]);
}
void set_region_vector(uint plane, uint at, vec3 a)
{
    uint first = plane * region_size + at;
    region[first] = a.x;
    region[first + region_size] = a.y;
    region[first + 2u * region_size] = a.z;
}
uint region_at(ivec2 place) { return uint(place.x - corner.x) * region_columns + uint(place.y - corner.y); }

vec3 near_position(ivec2 place) { return region_vector(0u, region_at(place)); }
vec3 near_velocity(ivec2 place) { return region_vector(3u, region_at(place)); }

void load_region()
{
    for (uint at = gl_LocalInvocationID.x; at < region_size; at += gl_WorkGroupSize.x) {
        ivec2 place = corner + ivec2(at / region_columns, at % region_columns);
        if (!on_sheet(place)) continue;
        uint node = node_at(place);
        set_region_vector(0u, at, position_of(node));
        set_region_vector(3u, at, velocity_of(node));
        region[6u * region_size + at] = position_in[node].w;
    }
}

// The m-th node of this invocation in a step with a margin of `margin` nodes on each side; false if there is none.
bool find_place(uint m, uint margin, out ivec2 place)
{
    uint columns = region_columns - 2u * margin, k = m * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    place = corner + ivec2(k / columns + margin, k % columns + margin);
    return k < columns * (region_rows - 2u * margin) && on_sheet(place);
}

void main()
{
    corner = ivec2(gl_WorkGroupID.yx * uvec2(tile_rows, tile_columns)) - int(halo);
    load_region();
    for (uint k = 0u; k < steps; ++k) {
        barrier();
        Motion next[most_nodes];
        ivec2 place;
        for (uint m = 0u; m < most_nodes; ++m) {
            if (!find_place(m, reach * (k + 1u), place)) continue;
            uint at = region_at(place), node = node_at(place);
            Motion now;
            now.position = region_vector(0u, at);
            now.velocity = region_vector(3u, at);
            float inverse_mass = region[6u * region_size + at];
            vec3 force = total_force(node, springs_force(place, now.position, now.velocity));
            next[m] = stepped(now, force, inverse_mass, push.index + k);
            if (k + 1u == steps) put_state(node, next[m], inverse_mass);
        }
        if (k + 1u == steps) return;
        barrier();
        for (uint m = 0u; m < most_nodes; ++m) {
            if (!find_place(m, reach * (k + 1u), place)) continue;
            set_region_vector(0u, region_at(place), next[m].position);
            set_region_vector(3u, region_at(place), next[m].velocity);
        }
    }
}
