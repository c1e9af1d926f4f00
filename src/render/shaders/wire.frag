#version 450

layout(location = 0) out vec4 colour;

void main()
{
    colour = vec4(0.01, 0.012, 0.02, 1.0);
}
