// A line of text in a picture.
#pragma once

#include <string>

#include "pliant/render.hpp"

namespace pliant::tool {

/// Writes ASCII into the upper left corner of the part of a picture that begins at a column, light on dark,
/// as large as suits the picture's height. What does not fit is cut off.
void write_label(Image& image, std::uint32_t first_column, const std::string& text);

}  // namespace pliant::tool
