// The nodes of a cloth on the device, pulled by index. `now` and `before` are the simulation's own positions, or uploaded;
// cloth_surface.comp makes what is seen of them.
#ifndef SURFACE_ACCESS  // who makes it defines it as nothing
#define SURFACE_ACCESS readonly
#endif
layout(set = 1, binding = 0) SURFACE_ACCESS buffer Positions { vec4 positions[]; };       // m, as seen: between two states
layout(set = 1, binding = 1) SURFACE_ACCESS buffer Normals { vec4 normals[]; };
layout(set = 1, binding = 2) SURFACE_ACCESS buffer Values { float values[]; };
layout(set = 1, binding = 3) readonly buffer Pattern { vec2 pattern[]; };  // place on the checker, in squares
layout(set = 1, binding = 4) readonly buffer Before { float before[]; };   // positions of the state before
layout(set = 1, binding = 5) readonly buffer Lines { uvec2 lines[]; };     // springs: `DrawnSpring` in C++
layout(set = 1, binding = 6) readonly buffer Points { vec4 points[]; };    // m; w: m, how deep it has sunk in
layout(set = 1, binding = 7) readonly buffer Held { uint held[]; };        // by spring: 1 where a constraint holds it
layout(set = 1, binding = 8) readonly buffer Now { float now[]; };         // positions of the last state
// Triangles around each node, as pairs of the other two, and springs, as a node and the length at rest; where those of a
// node begin comes first.
layout(set = 1, binding = 9) readonly buffer Ring { uint ring[]; };
layout(set = 1, binding = 10) readonly buffer Neighbours { uint neighbours[]; };
layout(set = 1, binding = 11) readonly buffer Edges { uvec4 edges[]; };  // two ends, then the third corners of the triangles at it
