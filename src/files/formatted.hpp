// Text by a format of printf, for messages.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

namespace pliant {

/// What printf would print, as a string of at most 1,023 characters.
template <class... Values>
std::string formatted(const char* format, Values... values)
{
    char text[1024];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

}  // namespace pliant
