#include "user_folders.hpp"

#include <cstdlib>

namespace pliant::tool {

std::filesystem::path cache_folder()
{
    // The base directory specification of freedesktop.org: relative paths are ignored.
    const char* const cache = std::getenv("XDG_CACHE_HOME");
    if (cache && std::filesystem::path(cache).is_absolute()) return std::filesystem::path(cache) / "pliant";
    const char* const home = std::getenv("HOME");
    if (home && std::filesystem::path(home).is_absolute())
        return std::filesystem::path(home) / ".cache" / "pliant";
    return {};
}

}  // namespace pliant::tool
