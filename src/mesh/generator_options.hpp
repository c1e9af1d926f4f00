// Checks of the generators' options.
#pragma once

#include <cstdint>
#include <string>

#include "files/formatted.hpp"
#include "pliant/error.hpp"

namespace pliant {

/// `name`: of the option, such as "icosphere.radius". NaN is refused, too.
inline void require_length(const char* name, double value)
{
    constexpr double longest = 1e4;
    if (value > 0 && value <= longest) return;
    throw Error(ErrorKind::bad_input, std::string(name) + " is " + number_text(value) +
                                          " m, but must be above 0 and at most 10000 m");
}

inline void require_count(const char* name, std::uint64_t value, std::uint64_t least, std::uint64_t most)
{
    if (value >= least && value <= most) return;
    throw Error(ErrorKind::bad_input, std::string(name) + " is " + std::to_string(value) +
                                          ", but must be a whole number between " + std::to_string(least) +
                                          " and " + std::to_string(most));
}

/// Options may each be in range and the mesh still be too large.
inline void require_vertex_count(const char* shape, std::uint64_t count)
{
    constexpr std::uint64_t most = 1u << 24;
    if (count <= most) return;
    throw Error(ErrorKind::bad_input, std::string(shape) + " would have " + std::to_string(count) +
                                          " vertices, but at most 16777216 are made; use fewer segments");
}

}  // namespace pliant
