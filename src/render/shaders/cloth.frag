#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "shading.glsl"
#include "pattern.glsl"
#include "value_colour.glsl"

layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 pattern_and_value;
layout(location = 3) flat in vec2 number;  // of the front and back surface
layout(location = 0) out vec4 colour;

void main()
{
    const vec3 front_dark = vec3(0.016, 0.155, 0.205), front_light = vec3(0.80, 0.72, 0.58);
    const vec3 back_dark = vec3(0.56, 0.115, 0.055), back_light = vec3(0.80, 0.66, 0.52);
    // Uses the geometric side: the interpolated normal would speckle along silhouettes.
    vec3 side = normalize(gl_FrontFacing ? normal : -normal);
    vec3 albedo;
    if (frame.colours != 0u)
        albedo = 0.85 * value_colour((pattern_and_value.z - frame.value_low) / (frame.value_high - frame.value_low));
    else
        albedo = mix(gl_FrontFacing ? front_dark : back_dark, gl_FrontFacing ? front_light : back_light,
                     checker(pattern_and_value.xy));
    colour = vec4(shade(albedo, point, side, 0.06, 18.0, 0.25), gl_FrontFacing ? number.x : number.y);
}
