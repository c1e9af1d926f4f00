// Pseudo-random numbers, the same on every machine, for irregular meshes.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace pliant {

/// Between 0 and 1, from the index alone: the finaliser of MurmurHash3 (Appleby), which spreads neighbouring
/// indices over all bits.
inline double scattered(std::uint32_t index)
{
    std::uint32_t h = index * 2'654'435'769u + 1u;
    h = (h ^ (h >> 16)) * 0x85EB'CA6Bu;
    h = (h ^ (h >> 13)) * 0xC2B2'AE35u;
    return static_cast<double>(h ^ (h >> 16)) / 4'294'967'296.0;
}

/// Two numbers, uniformly distributed in a disc of radius `most`.
struct Scatter {
    double x, y;
};
inline Scatter scatter(std::uint32_t index, double most)
{
    const double distance = most * std::sqrt(scattered(2 * index));
    const double direction = 2 * std::numbers::pi * scattered(2 * index + 1);
    return {distance * std::cos(direction), distance * std::sin(direction)};
}

}  // namespace pliant
