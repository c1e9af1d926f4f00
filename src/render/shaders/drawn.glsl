// The surfaces of the picture from the first pass, one sample per pixel.
layout(set = 2, binding = 0) uniform sampler2D drawn;        // alpha: number of the surface, shaders/surfaces.glsl
layout(set = 2, binding = 1) uniform sampler2D drawn_depth;

ivec2 inside(ivec2 pixel) { return clamp(pixel, ivec2(0), textureSize(drawn, 0) - 1); }
vec4 drawn_at(ivec2 pixel) { return texelFetch(drawn, inside(pixel), 0); }
float depth_at(ivec2 pixel) { return texelFetch(drawn_depth, inside(pixel), 0).r; }
