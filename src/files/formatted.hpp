// printf-style formatting, for messages.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

namespace pliant {

/// The output of printf as a string of at most 1,023 characters.
template <class... Values>
std::string formatted(const char* format, Values... values)
{
    char text[1024];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

}  // namespace pliant
