// The nodes of a cloth as the simulation keeps them on the device, pulled by index: nothing is copied for a picture.
layout(set = 1, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(set = 1, binding = 1) readonly buffer Normals { vec4 normals[]; };
layout(set = 1, binding = 2) readonly buffer Values { float values[]; };
layout(set = 1, binding = 3) readonly buffer Pattern { vec2 pattern[]; };  // place on the checker, in squares
layout(set = 1, binding = 4) readonly buffer Before { vec4 before[]; };    // positions of the state before
layout(set = 1, binding = 5) readonly buffer Lines { uvec4 lines[]; };     // springs: `DrawnSpring` in C++
layout(set = 1, binding = 6) readonly buffer Points { vec4 points[]; };    // m; w: m, how deep it has sunk in
layout(set = 1, binding = 7) readonly buffer Forces { float forces[]; };    // N, the largest of a constraint at the node

vec3 seen_position(uint node)
{
    // Where nothing is to blend, not even an infinity of the state before is looked at.
    return frame.blend < 1.0 ? mix(before[node].xyz, positions[node].xyz, frame.blend) : positions[node].xyz;
}
