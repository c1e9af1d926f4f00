// Fills slices of 16 lanes, see Slices in kernels.hpp.
#pragma once

#include <algorithm>
#include <vector>

#include "backend/cpu/kernels.hpp"

namespace pliant::cpu {

/// Appends a slice: calls add(lane, k, exists) for its entries in memory order, with as many rows as the
/// longest lane has entries. count(lane) returns the number of entries. `start` begins as {0}.
template <class Count, class Add>
void append_slice(std::vector<std::uint32_t>& start, Count count, Add add)
{
    std::size_t longest = 0;
    for (std::size_t lane = 0; lane < Slices::lanes; ++lane) longest = std::max(longest, count(lane));
    for (std::size_t k = 0; k < longest; ++k)
        for (std::size_t lane = 0; lane < Slices::lanes; ++lane) add(lane, k, k < count(lane));
    start.push_back(start.back() + static_cast<std::uint32_t>(longest));
}

}  // namespace pliant::cpu
