// A rigid shape: one of a few unit meshes, stretched and put in its place. `ShapePlacement` in render/shapes.hpp.
layout(push_constant) uniform Placement {
    vec4 axes[3];  // xyz: images of x, y and z; w: the centre's x, y and z
    vec4 size;     // xyz: scale; w: how far the two halves are moved apart along y
    vec4 colour;   // linear
} placement;

vec3 turned(vec3 local)
{
    return placement.axes[0].xyz * local.x + placement.axes[1].xyz * local.y + placement.axes[2].xyz * local.z;
}

// `corner`.w: -1 or 1, which half it belongs to.
vec3 placed(vec4 corner)
{
    vec3 local = corner.xyz * placement.size.xyz + vec3(0.0, corner.w * placement.size.w, 0.0);
    return turned(local) + vec3(placement.axes[0].w, placement.axes[1].w, placement.axes[2].w);
}
