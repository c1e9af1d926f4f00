// Smooth outlines. Surfaces are drawn with one sample per pixel. Where an outline passes through a pixel, the pixel is
// blended with its neighbour beyond the outline, by coverage (after E. Persson, "Geometric post-process anti-aliasing",
// 2011). Four samples per pixel look no better, and software rasterisers take three times as long for the many small
// triangles of a cloth.
layout(location = 0) flat out ivec2 across;  // the direction of the neighbours: the axis that the edge runs along least
layout(location = 1) out vec2 place;         // x: along the edge, 0 to 1; y: pixels across from it, along `across`
layout(location = 2) flat out float strength;

// In pixels and depth.
vec3 seen_at(vec4 clip) { return vec3((clip.xy / clip.w * 0.5 + 0.5) * frame.picture.xy, clip.z / clip.w); }

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// How much nearer the triangle gets within a pixel from the edge; its third corner is `away` pixels away.
float rise(vec3 first, vec2 along, float slope, vec3 corner, float away)
{
    float foot = dot(corner.xy - first.xy, along) / dot(along, along);
    return max(0.0, (first.z + foot * slope - corner.z) / max(1.0, abs(away)));
}

// A vertex of the quad that covers half a pixel on either side of an edge between two triangles. Degenerate unless one of
// the triangles hides the surface beyond. A `sharp` edge, of a shape seen only from outside, is drawn where either triangle
// is visible, more weakly for thin faces: beyond a face thinner than a pixel, the neighbour belongs to another surface.
void outline(vec4 first, vec4 second, vec4 third, vec4 fourth, bool border, bool sharp, int corner)
{
    vec3 a = seen_at(first), b = seen_at(second), c = seen_at(third), d = seen_at(fourth);
    vec2 along = b.xy - a.xy;
    float to_c = cross2(along, c.xy - a.xy) / length(along), to_d = cross2(along, d.xy - a.xy) / length(along);
    bool seen = border || (to_c > 0.0) != (to_d < 0.0);
    strength = 1.0;
    if (sharp) {
        strength = clamp(2.0 * max(-to_c, to_d) - 1.0, 0.0, 1.0);
        seen = strength > 0.0;
    }
    float nearest = min(min(first.w, second.w), min(third.w, fourth.w));
    if (!seen || !(nearest > 0.0) || !(dot(along, along) > 0.0)) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        across = ivec2(0);
        place = vec2(0.0);
        return;
    }
    bool steep = abs(along.y) > abs(along.x);
    across = steep ? ivec2(1, 0) : ivec2(0, 1);
    place = vec2(corner == 1 ? 2.0 : 0.0, corner == 2 ? 1.5 : -0.5);
    vec3 at = mix(a, b, place.x);
    float lift = max(rise(a, along, b.z - a.z, c, to_c), rise(a, along, b.z - a.z, d, to_d));
    gl_Position = vec4((at.xy + place.y * vec2(across)) * frame.picture.zw * 2.0 - 1.0, at.z - lift - 1e-6, 1.0);
}
