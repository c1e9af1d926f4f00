#version 450

layout(location = 0) in vec2 from_middle;
layout(location = 1) in float depth;  // m, below the surface; at most 0 in mere contact
layout(location = 0) out vec4 colour;

void main()
{
    float away = length(from_middle), covered = clamp((1.0 - away) / fwidth(away) + 0.5, 0.0, 1.0);
    colour = vec4(depth > 0.0 ? vec3(0.9, 0.02, 0.02) : vec3(0.95, 0.50, 0.02), covered);
}
