// Anti-aliased patterns: each is filtered over the footprint of the pixel.

// 0 or 1 over squares of edge 1, after I. Quilez, "filtering the checkerboard pattern" (box filter).
float checker(vec2 at)
{
    vec2 width = max(abs(dFdx(at)), abs(dFdy(at))) + 1e-4;
    vec2 part = 2.0 * (abs(fract(0.5 * (at - 0.5 * width)) - 0.5) - abs(fract(0.5 * (at + 0.5 * width)) - 0.5)) / width;
    return clamp(0.5 - 0.5 * part.x * part.y, 0.0, 1.0);
}

// The part of a pixel covered by grid lines of this width at the integers.
float grid(vec2 at, float line)
{
    vec2 width = max(abs(dFdx(at)), abs(dFdy(at))) + 1e-5;
    vec2 from = at - 0.5 * width + 0.5 * line, to = at + 0.5 * width + 0.5 * line;
    vec2 covered = (floor(to) * line + min(fract(to), line) - floor(from) * line - min(fract(from), line)) / width;
    return 1.0 - (1.0 - clamp(covered.x, 0.0, 1.0)) * (1.0 - clamp(covered.y, 0.0, 1.0));
}
