#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "shape.glsl"

layout(location = 0) in vec4 corner;

void main()
{
    vec4 at = frame.shadow_from_world * vec4(placed(corner), 1.0);
    gl_Position = vec4(at.xy * 2.0 - 1.0, at.z, 1.0);
}
