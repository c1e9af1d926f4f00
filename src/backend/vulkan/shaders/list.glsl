#ifndef LIST_GLSL
#define LIST_GLSL
// Springs as a list, and the springs around each node.
#include "cloth.glsl"

layout(set = 0, binding = binding_springs, std430) readonly buffer Springs { uvec2 springs[]; };              // nodes i < j
layout(set = 0, binding = binding_spring_rest_class, std430) readonly buffer RestLengths { vec4 spring_rest_class[]; };  // m, class, scale, N/m
layout(set = 0, binding = binding_neighbour_start, std430) readonly buffer NeighbourStart { uint neighbour_start[]; };
layout(set = 0, binding = binding_neighbours, std430) readonly buffer Neighbours { uvec2 neighbours[]; };  // node, spring

uint spring_class_of(uint spring) { return uint(spring_rest_class[spring].y); }
float spring_rest_of(uint spring) { return spring_rest_class[spring].x; }
float spring_scale_of(uint spring) { return spring_rest_class[spring].z; }
float spring_bending_of(uint spring) { return spring_rest_class[spring].w; }
#endif
