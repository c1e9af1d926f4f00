// Rows of different length in one array.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pliant {

/// Row i is entries[start[i]] ... entries[start[i + 1] - 1].
template <class Entry>
struct Ragged {
    std::vector<std::uint32_t> start;
    std::vector<Entry> entries;
    std::size_t row_count() const { return start.empty() ? 0 : start.size() - 1; }
    std::span<const Entry> row(std::size_t i) const
    {
        return {entries.data() + start[i], entries.data() + start[i + 1]};
    }
};

}  // namespace pliant
