// The grid of a sheet, and the springs between its nodes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "body/spring.hpp"

namespace pliant {

/// One of the up to 12 springs of a sheet's node.
struct SheetNeighbour {
    int row_offset = 0, column_offset = 0;
    SpringClass spring_class = SpringClass::structural;
    int rest = 0;    ///< index into SheetShape::rest_lengths
    int number = 0;  ///< among the six springs that begin at a node, in the solver's planes
};

/// In the canonical order of a node's springs.
inline constexpr SheetNeighbour sheet_neighbours[12] = {
#define SHEET_NEIGHBOUR(rows, columns, spring, rest, number) \
    {                                                        \
        rows, columns, SpringClass::spring, rest, number     \
    }
#include "kernels/sheet_neighbours.glsl"
#undef SHEET_NEIGHBOUR
};
/// The springs that begin at a node: sheet_neighbours[first_forward_neighbour] and the five after it.
inline constexpr std::size_t first_forward_neighbour = 6;

struct SheetShape {
    std::uint32_t rows = 0, columns = 0;
    std::array<double, 2> spacing{};  ///< m, of nodes along a row and along a column
    /// m: along a row, along a column, diagonal, two along a row, two along a column; SpringSet sets them
    std::array<double, 5> rest_lengths{};

    /// Structural and shear springs.
    std::uint64_t measured_spring_count() const
    {
        const std::uint64_t r = rows, c = columns;
        return r * (c - 1) + (r - 1) * c + 2 * (r - 1) * (c - 1);
    }
    std::uint64_t spring_count() const
    {
        const std::uint64_t r = rows, c = columns;
        return measured_spring_count() + r * (c - 2) + (r - 2) * c;
    }
};

/// Visits the springs of a sheet in the order of (i, j): f(i, j, const SheetNeighbour&).
template <class Function>
void for_each_sheet_spring(const SheetShape& sheet, Function&& f)
{
    for (std::uint32_t row = 0; row < sheet.rows; ++row)
        for (std::uint32_t column = 0; column < sheet.columns; ++column)
            for (std::size_t n = first_forward_neighbour; n < std::size(sheet_neighbours); ++n) {
                const std::int64_t r = row + std::int64_t{sheet_neighbours[n].row_offset};
                const std::int64_t c = column + std::int64_t{sheet_neighbours[n].column_offset};
                if (r < 0 || c < 0 || r >= sheet.rows || c >= sheet.columns) continue;
                f(row * sheet.columns + column, static_cast<std::uint32_t>(r * sheet.columns + c),
                  sheet_neighbours[n]);
            }
}

}  // namespace pliant
