#include "label.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wcast-qual"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace pliant::tool {
namespace {

/// A vertex of stb_easy_font; four form an axis-aligned rectangle.
struct Corner {
    float x = 0, y = 0, z = 0;
    unsigned char colour[4] = {};
};

using Colour = std::uint8_t;

void fill(Image& image, long left, long top, long right, long bottom, Colour shade)
{
    right = std::min<long>(right, image.width);
    bottom = std::min<long>(bottom, image.height);
    for (long y = std::max(0l, top); y < bottom; ++y)
        for (long x = std::max(0l, left); x < right; ++x) {
            std::uint8_t* pixel =
                &image.rgba[4 * (static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x))];
            pixel[0] = pixel[1] = pixel[2] = shade;
        }
}

}  // namespace

void write_label(Image& image, std::uint32_t first_column, const std::string& text)
{
    constexpr Colour dark = 24, light = 236;
    constexpr long pixels_for_each_scale = 240;
    const long scale = std::max(1l, image.height / pixels_for_each_scale), margin = 3 * scale;
    std::string copy = text;  // the library's parameter is not const
    std::vector<Corner> corners(4 * 64 * (text.size() + 1));
    const int rectangles = stb_easy_font_print(0, 0, copy.data(), nullptr, corners.data(),
                                               static_cast<int>(corners.size() * sizeof(Corner)));
    const long left = first_column + margin, top = margin;
    fill(image, left, top, left + scale * stb_easy_font_width(copy.data()) + 2 * margin,
         top + scale * 10 + 2 * margin, dark);
    const auto place = [&](float a) { return static_cast<long>(std::lround(a)) * scale; };
    for (int k = 0; k < rectangles; ++k) {
        const Corner& from = corners[4 * static_cast<std::size_t>(k)];
        const Corner& to = corners[4 * static_cast<std::size_t>(k) + 2];
        fill(image, left + margin + place(from.x), top + margin + place(from.y), left + margin + place(to.x),
             top + margin + place(to.y), light);
    }
}

}  // namespace pliant::tool
