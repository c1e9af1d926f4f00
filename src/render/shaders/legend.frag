#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "legend.glsl"
#include "strain_colour.glsl"

layout(location = 0) out vec4 colour;

// Letters of 5 x 7 squares, five bits a row from the top, the lowest bit at the left: 0 to 9, then %, s, t, r, a, i, n.
const int glyph_count = 17, percent = 10, blank = -1;
const uvec2 glyphs[glyph_count] = uvec2[](
    uvec2(0xae62eu, 0x3a33u), uvec2(0x210c4u, 0x3884u), uvec2(0x6422eu, 0x7c22u), uvec2(0x6422eu, 0x3a30u),
    uvec2(0x4a988u, 0x211fu), uvec2(0x83c3fu, 0x3a30u), uvec2(0x7844cu, 0x3a31u), uvec2(0x2221fu, 0x0842u),
    uvec2(0x7462eu, 0x3a31u), uvec2(0xf462eu, 0x1910u), uvec2(0x22263u, 0x6322u), uvec2(0x0f800u, 0x3e0eu),
    uvec2(0x11c42u, 0x3242u), uvec2(0x9b400u, 0x0421u), uvec2(0x83800u, 0x7a3eu), uvec2(0x21804u, 0x3884u),
    uvec2(0x9b400u, 0x4631u));

// Is there ink of this letter at a square counted from the letter's upper left corner?
bool ink(int glyph, ivec2 at)
{
    if (glyph < 0 || any(lessThan(at, ivec2(0))) || at.x > 4 || at.y > 6) return false;
    uvec2 rows = glyphs[glyph];
    return (((at.y < 4 ? rows.x : rows.y) >> (5 * (at.y & 3) + at.x)) & 1u) != 0u;
}

void main()
{
    ivec2 at = ivec2((gl_FragCoord.xy - legend_corner()) / legend_unit());
    if (at.y >= 10 && at.y < 16) {
        colour = vec4(strain_colour((float(at.x) + 0.5) / legend_size.x), 1.0);
        return;
    }
    int letter = blank, origin = 0;
    int range = int(frame.strain_range * 100.0 + 0.5), tens = (range / 10) % 10;
    if (at.y < 7) {
        const int title[6] = int[](11, 12, 13, 14, 15, 16);
        letter = at.x / 6 < 6 ? title[at.x / 6] : blank;
        origin = (at.x / 6) * 6;
    } else if (at.y >= 19 && at.x < 60) {
        const int least[3] = int[](0, blank, percent);
        letter = at.x / 6 < 3 ? least[at.x / 6] : blank;
        origin = (at.x / 6) * 6;
    } else if (at.y >= 19) {
        int from = int(legend_size.x) - 23, place = (at.x - from) / 6;
        int most[4] = int[](tens > 0 ? tens : blank, range % 10, blank, percent);
        letter = at.x >= from && place < 4 ? most[place] : blank;
        origin = from + place * 6;
    }
    if (!ink(letter, at - ivec2(origin, at.y < 7 ? 0 : 19))) discard;
    colour = vec4(0.03, 0.035, 0.045, 1.0);
}
