// The nodes of a cloth as the simulation keeps them on the device, pulled by index: nothing is copied for a picture.
layout(set = 1, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(set = 1, binding = 1) readonly buffer Normals { vec4 normals[]; };
layout(set = 1, binding = 2) readonly buffer Strains { float strains[]; };
layout(set = 1, binding = 3) readonly buffer Pattern { vec2 pattern[]; };  // place on the checker, in squares
