#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "legend.glsl"
#include "value_colour.glsl"

layout(location = 0) out vec4 colour;

// Letters of 5 x 7 squares, five bits a row from the top, the lowest bit at the left: 0123456789%strainfocevlumN-.+k
const int glyph_count = 30;
const uvec2 glyphs[glyph_count] = uvec2[](
    uvec2(0xae62eu, 0x3a33u), uvec2(0x210c4u, 0x3884u), uvec2(0x6422eu, 0x7c22u), uvec2(0x6422eu, 0x3a30u),
    uvec2(0x4a988u, 0x211fu), uvec2(0x83c3fu, 0x3a30u), uvec2(0x7844cu, 0x3a31u), uvec2(0x2221fu, 0x0842u),
    uvec2(0x7462eu, 0x3a31u), uvec2(0xf462eu, 0x1910u), uvec2(0x22263u, 0x6322u), uvec2(0x0f800u, 0x3e0eu),
    uvec2(0x11c42u, 0x3242u), uvec2(0x9b400u, 0x0421u), uvec2(0x83800u, 0x7a3eu), uvec2(0x21804u, 0x3884u),
    uvec2(0x9b400u, 0x4631u), uvec2(0x7884cu, 0x0842u), uvec2(0x8b800u, 0x3a31u), uvec2(0x0f800u, 0x7821u),
    uvec2(0x8b800u, 0x383fu), uvec2(0x8c400u, 0x1151u), uvec2(0x21086u, 0x3884u), uvec2(0x8c400u, 0x7a31u),
    uvec2(0xaac00u, 0x56b5u), uvec2(0xcd671u, 0x4631u), uvec2(0x78000u, 0x0000u), uvec2(0x00000u, 0x18c0u),
    uvec2(0xf9080u, 0x0084u), uvec2(0x2a421u, 0x24a3u));

// Whether this letter has ink at a square, counted from its upper left corner.
bool ink(int glyph, ivec2 at)
{
    if (glyph >= glyph_count || any(lessThan(at, ivec2(0))) || at.x > 4 || at.y > 6) return false;
    uvec2 rows = glyphs[glyph];
    return (((at.y < 4 ? rows.x : rows.y) >> (5 * (at.y & 3) + at.x)) & 1u) != 0u;
}

int letter_of(uvec4 text, int place)
{
    return place >= 0 && place < 16 ? int(text[place >> 2] >> (8 * (place & 3)) & 255u) : glyph_count;
}

void main()
{
    ivec2 at = ivec2((gl_FragCoord.xy - legend_corner()) / legend_unit());
    if (at.y >= 10 && at.y < 16) {
        colour = vec4(value_colour((float(at.x) + 0.5) / legend_size.x), 1.0);
        return;
    }
    const int high_from = int(legend_size.x) - 8 * 6 + 1;  // right-aligns its eight letters with the bar
    int letter, origin;
    if (at.y < 7) {
        letter = letter_of(legend.title, at.x / 6);
        origin = (at.x / 6) * 6;
    } else if (at.y >= 19 && at.x < high_from) {
        letter = letter_of(legend.low, at.x / 6);
        origin = (at.x / 6) * 6;
    } else {
        letter = at.y >= 19 ? letter_of(legend.high, (at.x - high_from) / 6) : glyph_count;
        origin = high_from + ((at.x - high_from) / 6) * 6;
    }
    if (!ink(letter, at - ivec2(origin, at.y < 7 ? 0 : 19))) discard;
    colour = vec4(0.03, 0.035, 0.045, 1.0);
}
