// Light: one shadowed sun, a weak opposite light that keeps shapes readable in the shadow, and an ambient term between sky
// and ground. Colours are linear; the target's sRGB format encodes them.
layout(set = 0, binding = 1) uniform sampler2DShadow shadow_map;

const vec3 sun     = vec3(0.98, 0.93, 0.85);
const vec3 fill    = vec3(0.10, 0.12, 0.16);
const vec3 sky     = vec3(0.36, 0.39, 0.44);
const vec3 bounce  = vec3(0.25, 0.235, 0.22);

// Studio backdrop. `height` is 0 at the top of the picture and 1 at the bottom.
vec3 backdrop(float height)
{
    const vec3 above = vec3(0.36, 0.42, 0.48), below = vec3(0.58, 0.61, 0.63);
    return mix(above, below, smoothstep(-0.1, 0.7, height));
}

// The visible part of the sun at a point, 0 to 1. `side` is the normal on the lit side. If not `wanted`, returns 1 without
// sampling.
float sunlight(vec3 point, vec3 side, bool wanted)
{
    // Offset by half the filter's width times the slope towards the sun, so that no surface shadows itself.
    vec3 lifted = point + side * (2.5 * frame.shadow_texel);
    vec3 at = (frame.shadow_from_world * vec4(lifted, 1.0)).xyz;
    vec2 border = abs(at.xy - 0.5);
    bool inside = wanted && max(border.x, border.y) < 0.497 && at.z < 1.0;

    // 3 x 3 bilinear comparisons, the corners first. If these agree the rest is skipped: most of a picture is fully lit or
    // fully in shadow. Loop counts depend on data so that a CPU, which runs masked lanes in lockstep, leaves the loop when
    // the whole group is done.
    int corners = inside ? 4 : 0;
    float lit = inside ? 0.0 : 4.0;
    vec2 spread = 1.6 / vec2(textureSize(shadow_map, 0));
    for (int tap = 0; tap < corners; ++tap) {
        vec2 offset = vec2((tap & 1) * 2 - 1, (tap & 2) - 1);
        lit += texture(shadow_map, vec3(at.xy + offset * spread, at.z));
    }
    int others = lit > 0.0 && lit < 4.0 ? 5 : 0;
    lit *= others > 0 ? 1.0 : 9.0 / 4.0;
    for (int tap = 0; tap < others; ++tap) {
        vec2 offset = tap < 2 ? vec2(tap * 2 - 1, 0.0) : tap < 4 ? vec2(0.0, tap * 2 - 5) : vec2(0.0);
        lit += texture(shadow_map, vec3(at.xy + offset * spread, at.z));
    }
    return lit / 9.0;
}

vec3 ambient(vec3 normal)
{
    return mix(bounce, sky, 0.5 + 0.5 * normal.y);
}

// Ambient, diffuse and (Blinn-Phong) specular light. `through` is the part of the sun that passes through thin cloth.
vec3 shade(vec3 albedo, vec3 point, vec3 normal, float gloss, float shininess, float through)
{
    float towards = dot(normal, frame.to_light.xyz);
    vec3 to_eye = normalize(frame.eye.xyz - point);
    vec3 halfway = normalize(frame.to_light.xyz + to_eye);
    float highlight = towards > 0.0 ? gloss * pow(max(dot(normal, halfway), 0.0), shininess) : 0.0;
    float edge = 1.0 - max(dot(normal, to_eye), 0.0);
    float diffuse = max(towards, 0.0) + through * max(-towards, 0.0);
    float visible = sunlight(point, towards < 0.0 ? -normal : normal, diffuse > 0.0);  // otherwise it would only scale zeros
    vec3 light = ambient(normal) + fill * max(-dot(normal.xz, frame.to_light.xz), 0.0) + sun * (diffuse * visible);
    return albedo * light + sun * (highlight * visible) + sky * (0.25 * gloss * edge * edge * edge);
}
