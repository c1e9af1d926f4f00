// Image files.
#pragma once

#include <filesystem>

#include "render/image.hpp"

namespace pliant {

/// The file appears under its name only when it is complete. Throws Error(bad_input), naming the file and the
/// reason, if it cannot be written; an existing file is then unchanged.
void write_png(const std::filesystem::path& file, const Image& image);

}  // namespace pliant
