// Where the tool may keep things between runs.
#pragma once

#include <filesystem>

namespace pliant::tool {

/// Pliant's folder for what can be made anew: in $XDG_CACHE_HOME, else ~/.cache. Empty where neither is
/// known.
std::filesystem::path cache_folder();

}  // namespace pliant::tool
