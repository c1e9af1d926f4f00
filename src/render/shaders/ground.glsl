// A horizontal floor that fades into the backdrop. `GroundPlacement` in render/shapes.hpp.
layout(push_constant) uniform Ground {
    vec4 place;      // xyz: the centre in m; w: the radius in m at which it has faded
    float spacing;   // m between grid lines; every fifth is stronger
    float strength;  // 1 for a collider, less for a floor that only receives the shadow
} ground;
