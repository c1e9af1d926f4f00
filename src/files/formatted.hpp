// printf-style formatting, for messages.
#pragma once

#include <charconv>
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

/// The shortest text that reads as the same number.
template <class Number>
std::string number_text(Number value)
{
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace pliant
