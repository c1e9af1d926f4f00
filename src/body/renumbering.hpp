// Values of nodes and rows of nodes in another order.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "body/ragged.hpp"

namespace pliant {

/// At place k comes the value that was at order[k].
template <class Value>
void reorder(std::vector<Value>& values, std::span<const std::uint32_t> order)
{
    std::vector<Value> before = std::exchange(values, std::vector<Value>(values.size()));
    for (std::size_t node = 0; node < order.size(); ++node) values[node] = before[order[node]];
}

/// At order[k] comes k.
inline std::vector<std::uint32_t> inverse_of(std::span<const std::uint32_t> order)
{
    std::vector<std::uint32_t> places(order.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) places[order[k]] = k;
    return places;
}

template <class Entry>
void reorder_rows(Ragged<Entry>& rows, std::span<const std::uint32_t> order)
{
    const Ragged<Entry> before = std::exchange(rows, {});
    rows.start.push_back(0);
    for (const std::uint32_t vertex : order) {
        const auto row = before.row(vertex);
        rows.entries.insert(rows.entries.end(), row.begin(), row.end());
        rows.start.push_back(static_cast<std::uint32_t>(rows.entries.size()));
    }
}

template <class Value>
void append(std::vector<Value>& to, const std::vector<Value>& from)
{
    to.insert(to.end(), from.begin(), from.end());
}

/// Appends rows, each entry as `moved` makes it; returns how many entries there were.
template <class Entry, class Moved>
std::uint32_t append_rows(Ragged<Entry>& to, const Ragged<Entry>& from, Moved moved)
{
    const auto first = static_cast<std::uint32_t>(to.entries.size());
    for (std::size_t k = 1; k < from.start.size(); ++k) to.start.push_back(from.start[k] + first);
    for (const Entry& entry : from.entries) to.entries.push_back(moved(entry));
    return first;
}

}  // namespace pliant
