#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "shading.glsl"
#include "surfaces.glsl"
#include "pattern.glsl"
#include "ground.glsl"

layout(location = 0) in vec3 point;
layout(location = 0) out vec4 colour;

void main()
{
    const vec3 albedo = vec3(0.60, 0.595, 0.58);
    vec2 at = (point.xz) / ground.spacing;
    float away = length(point.xz - ground.place.xz) / ground.place.w;

    float lines = max(0.35 * grid(at, 0.012), 0.7 * grid(at * 0.2, 0.005)) * (1.0 - smoothstep(0.03, 0.30, away));
    float present = ground.strength * (1.0 - smoothstep(0.0, 0.5, away));
    vec3 light = ambient(vec3(0.0, 1.0, 0.0)) + sun * (frame.to_light.y * sunlight(point, vec3(0.0, 1.0, 0.0), present > 0.0));
    vec3 floor_colour = albedo * (1.0 - lines * ground.strength * 0.55) * light;
    colour = vec4(mix(backdrop(gl_FragCoord.y * frame.picture.w), floor_colour, present), ground_number);
}
