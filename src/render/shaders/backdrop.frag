#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "shading.glsl"
#include "surfaces.glsl"

layout(location = 0) out vec4 colour;

void main()
{
    colour = vec4(backdrop(gl_FragCoord.y * frame.picture.w), backdrop_number);
}
