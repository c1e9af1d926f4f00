#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "cloth_nodes.glsl"

void main()
{
    gl_Position = frame.clip_from_world * vec4(positions[gl_VertexIndex].xyz, 1.0);
}
