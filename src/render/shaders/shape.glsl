// A rigid shape: a scaled and placed unit mesh. `ShapePlacement` in render/shapes.hpp.
layout(push_constant) uniform Placement {
    vec4 axes[3];  // xyz: images of x, y and z; w: the centre's x, y and z
    vec4 size;     // xyz: scale; w: distance by which each half is moved along y
    vec4 ends;     // x, y: radii of the upper and the lower half; z: the seam between them, see ShapeEnds
    vec4 colour;   // linear
} placement;

vec3 turned(vec3 local)
{
    return placement.axes[0].xyz * local.x + placement.axes[1].xyz * local.y + placement.axes[2].xyz * local.z;
}

// A direction of the unit sphere, moved towards the upper pole so that the equator maps to the seam.
vec3 tilted(vec3 unit)
{
    float tilt = placement.ends.z;
    if (tilt == 0.0) return unit;
    float y = unit.y + tilt * (1.0 - abs(unit.y)), around = length(unit.xz);
    return vec3(unit.xz * (around > 0.0 ? sqrt(max(0.0, 1.0 - y * y)) / around : 0.0), y).xzy;
}

// `corner`.w: the half to which it belongs, -1 or 1.
vec3 placed(vec4 corner)
{
    vec3 local = tilted(corner.xyz) * placement.size.xyz;
    local *= corner.w > 0.0 ? placement.ends.x : placement.ends.y;
    local.y += corner.w * placement.size.w;
    return turned(local) + vec3(placement.axes[0].w, placement.axes[1].w, placement.axes[2].w);
}
