#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "ground.glsl"

layout(location = 0) out vec3 point;

void main()
{
    // A strip of two triangles, counter-clockwise from above.
    vec2 corner = vec2((gl_VertexIndex & 1) * 2 - 1, 1 - (gl_VertexIndex & 2));
    point = ground.place.xyz + vec3(corner.x, 0.0, corner.y) * ground.place.w;
    gl_Position = frame.clip_from_world * vec4(point, 1.0);
}
