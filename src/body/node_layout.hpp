// The offsets of nodes in a plane of numbers.
#pragma once

#include <cstddef>

#include "kernels/planes.hpp"

namespace pliant {

/// Nodes in rows, each row padded, with a border of padding all around: a kernel may read two nodes beyond
/// any side, and write a whole SIMD pack at a row's end, without leaving the plane. A mesh is one row.
/// Padding is zero with inverse mass 0, so that results there stay 0.
struct NodeLayout {
    static constexpr std::size_t pad = row_pad;  ///< floats; the widest pack, and a cache line
    static constexpr std::size_t border_rows = pliant::border_rows;

    NodeLayout(std::size_t row_count, std::size_t column_count)
        : rows(row_count),
          columns(column_count),
          stride((column_count + pad - 1) / pad * pad + pad),
          size((row_count + 2 * border_rows) * stride + 2 * pad)
    {
    }
    std::size_t offset(std::size_t row, std::size_t column) const
    {
        return (row + border_rows) * stride + pad + column;
    }
    std::size_t offset(std::size_t node) const { return offset(node / columns, node % columns); }

    std::size_t rows, columns, stride, size;
};

}  // namespace pliant
