// Frame constants for every shader. `FrameUniforms` in render/stage.hpp is the same in C++.
layout(set = 0, binding = 0) uniform Frame {
    mat4 clip_from_world;
    mat4 shadow_from_world;  // xy in [0, 1] over the shadow map, z the depth in it
    vec4 eye;                // m
    vec4 to_light;           // unit length
    vec4 picture;            // width and height in pixels, 1 / both
    float shadow_texel;      // m, edge of a texel of the shadow map
    float value_low, value_high;  // the ends of the colour map
    float blend;             // position between the previous state (0) and the current one (1)
    uint colours;            // cloth: 0 checker, 1 by value, 2 by value around a middle
} frame;
