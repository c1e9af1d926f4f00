// Folders in which the tool keeps files between runs.
#pragma once

#include <filesystem>

namespace pliant::tool {

/// Pliant's folder for files that can be recreated: in $XDG_CACHE_HOME, else ~/.cache. Empty if neither is
/// set.
std::filesystem::path cache_folder();

}  // namespace pliant::tool
