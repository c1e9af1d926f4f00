// The surfaces of the picture as the first pass has drawn them, one sample for each pixel.
layout(set = 2, binding = 0) uniform sampler2D drawn;        // alpha: which surface, shaders/surfaces.glsl
layout(set = 2, binding = 1) uniform sampler2D drawn_depth;

ivec2 inside(ivec2 pixel) { return clamp(pixel, ivec2(0), textureSize(drawn, 0) - 1); }
vec4 drawn_at(ivec2 pixel) { return texelFetch(drawn, inside(pixel), 0); }
float depth_at(ivec2 pixel) { return texelFetch(drawn_depth, inside(pixel), 0).r; }
