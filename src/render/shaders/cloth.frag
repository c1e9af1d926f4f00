#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "shading.glsl"
#include "pattern.glsl"
#include "strain_colour.glsl"

layout(constant_id = 0) const bool show_strain = false;

layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 pattern_and_strain;
layout(location = 0) out vec4 colour;

void main()
{
    const vec3 front_dark = vec3(0.016, 0.155, 0.205), front_light = vec3(0.80, 0.72, 0.58);
    const vec3 back_dark = vec3(0.56, 0.115, 0.055), back_light = vec3(0.80, 0.66, 0.52);
    // The geometric side decides, not the interpolated normal, which would speckle along silhouettes.
    vec3 side = normalize(gl_FrontFacing ? normal : -normal);
    vec3 albedo;
    if (show_strain)
        albedo = 0.85 * strain_colour(pattern_and_strain.z / frame.strain_range);
    else
        albedo = mix(gl_FrontFacing ? front_dark : back_dark, gl_FrontFacing ? front_light : back_light,
                     checker(pattern_and_strain.xy));
    colour = vec4(shade(albedo, point, side, 0.06, 18.0, 0.25), 1.0);
}
