// Pictures as files.
#pragma once

#include <filesystem>

#include "render/image.hpp"

namespace pliant {

/// The file appears under its name only when it is complete. Throws Error(bad_input), naming the file and the
/// reason, when it cannot be written; a file that was there before is then untouched.
void write_png(const std::filesystem::path& file, const Image& image);

}  // namespace pliant
