#version 450

layout(location = 0) in vec3 hue;
layout(location = 1) noperspective in float beside;
layout(location = 0) out vec4 colour;

void main()
{
    colour = vec4(hue, max(0.0, 1.0 - abs(beside)));  // coverage by a line of one pixel's width
}
