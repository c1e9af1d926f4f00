#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "legend.glsl"

void main()
{
    vec2 pixel = legend_corner() + vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * legend_size * legend_unit();
    gl_Position = vec4(pixel * frame.picture.zw * 2.0 - 1.0, 0.0, 1.0);
}
