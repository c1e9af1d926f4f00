// Light: one shadowed sun, a weak light from the other side that keeps shapes readable in the shadow, and an ambient
// term between the sky above and the ground below. Colours are linear; the target's sRGB format encodes them.
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

// The part of the sun that reaches a point, 0 to 1. `side` is the normal on the side that the sun shines on; where the
// answer is not `wanted` it is 1, and costs nothing.
float sunlight(vec3 point, vec3 side, bool wanted)
{
    // Half the filter's width times the slope towards the sun: no surface shades itself.
    vec3 lifted = point + side * (2.5 * frame.shadow_texel);
    vec3 at = (frame.shadow_from_world * vec4(lifted, 1.0)).xyz;
    vec2 border = abs(at.xy - 0.5);
    bool inside = wanted && max(border.x, border.y) < 0.497 && at.z < 1.0;

    // 3 x 3 bilinear comparisons, the corners first: where they agree the rest is not asked, as most of a picture
    // lies in the full sun or the full shade. The counts depend on data, so that a machine that runs masked lanes in
    // lockstep (a CPU) leaves a loop at once where the whole group has no need of it.
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

// Ambient, diffuse and (Blinn-Phong) specular light. `through` is the part of the sun that thin cloth lets pass.
vec3 shade(vec3 albedo, vec3 point, vec3 normal, float gloss, float shininess, float through)
{
    float towards = dot(normal, frame.to_light.xyz);
    vec3 to_eye = normalize(frame.eye.xyz - point);
    vec3 halfway = normalize(frame.to_light.xyz + to_eye);
    float highlight = towards > 0.0 ? gloss * pow(max(dot(normal, halfway), 0.0), shininess) : 0.0;
    float edge = 1.0 - max(dot(normal, to_eye), 0.0);
    float diffuse = max(towards, 0.0) + through * max(-towards, 0.0);
    float visible = sunlight(point, towards < 0.0 ? -normal : normal, diffuse > 0.0);  // else all that it scales is 0
    vec3 light = ambient(normal) + fill * max(-dot(normal.xz, frame.to_light.xz), 0.0) + sun * (diffuse * visible);
    return albedo * light + sun * (highlight * visible) + sky * (0.25 * gloss * edge * edge * edge);
}
