// The nodes of a cloth on the device, fetched by index. `now` and `before` are the simulation's own positions, or uploaded
// ones; cloth_surface.comp computes the visible state from them.
#ifndef SURFACE_ACCESS  // cloth_surface.comp, which writes it, defines it as empty
#define SURFACE_ACCESS readonly
#endif
layout(set = 1, binding = 0) SURFACE_ACCESS buffer Positions { vec4 positions[]; };       // m, visible: between two states
layout(set = 1, binding = 1) SURFACE_ACCESS buffer Normals { vec4 normals[]; };
layout(set = 1, binding = 2) SURFACE_ACCESS buffer Values { float values[]; };
layout(set = 1, binding = 3) readonly buffer Pattern { vec2 pattern[]; };  // place on the checker, in squares
layout(set = 1, binding = 4) readonly buffer Before { float before[]; };   // positions of the previous state
layout(set = 1, binding = 5) readonly buffer Lines { uvec2 lines[]; };     // springs: `DrawnSpring` in C++
layout(set = 1, binding = 6) readonly buffer Points { vec4 points[]; };    // m; w: penetration, m
layout(set = 1, binding = 7) readonly buffer Held { uint held[]; };        // by spring: 1 if a constraint holds it
layout(set = 1, binding = 8) readonly buffer Now { float now[]; };         // positions of the current state
// Triangles around each node, as pairs of the other two nodes; and springs, as a node and the rest length. The beginnings of
// the nodes' lists come first.
layout(set = 1, binding = 9) readonly buffer Ring { uint ring[]; };
layout(set = 1, binding = 10) readonly buffer Neighbours { uint neighbours[]; };
layout(set = 1, binding = 11) readonly buffer Edges { uvec4 edges[]; };  // two ends, then the third corners of the triangles at it
