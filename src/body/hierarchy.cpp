#include "body/hierarchy.hpp"

#include <algorithm>
#include <utility>

#include "body/cloth_model.hpp"
#include "body/node_layout.hpp"
#include "kernels/planes.hpp"
#include "pliant/error.hpp"

namespace pliant {

Hierarchy::Hierarchy(const ClothModel& cloth)
{
    if (cloth.plan.solver == Solver::paper) {
        build_rows(cloth);
        return;
    }
    if (cloth.plan.on_grid)
        build_sheet(cloth);
    else
        build_mesh(cloth);
    if (cloth.plan.corrects_steps()) append_live_flags();
    const std::size_t bottom = 3 * std::size_t(levels.back().rows) * std::size_t(levels.back().columns);
    bottom_base = static_cast<std::int32_t>(number_count);
    number_count += bottom * bottom;
    if (number_count > 0x7fffffff)
        throw Error(ErrorKind::bad_input,
                    "a cloth of " + std::to_string(cloth.node_count()) +
                        " nodes is too large for the constraint solver, which can "
                        "number 2^31 values; use fewer nodes or the method mass_spring");
}

std::int32_t Hierarchy::offset(const SolverLevel& level, std::int32_t row, std::int32_t column)
{
    constexpr auto border = static_cast<std::int32_t>(NodeLayout::border_rows);
    return (row + border) * level.stride + static_cast<std::int32_t>(NodeLayout::pad) + column;
}

SolverLevel Hierarchy::append_level(std::int32_t rows, std::int32_t columns, std::int32_t planes)
{
    const NodeLayout layout(static_cast<std::size_t>(rows), static_cast<std::size_t>(columns));
    SolverLevel level;
    level.rows = rows;
    level.columns = columns;
    level.stride = static_cast<std::int32_t>(layout.stride);
    level.size =
        static_cast<std::int32_t>((layout.size + NodeLayout::pad - 1) / NodeLayout::pad * NodeLayout::pad);
    level.base = static_cast<std::int32_t>(number_count);
    number_count += static_cast<std::size_t>(planes) * static_cast<std::size_t>(level.size);
    levels.push_back(level);
    return level;
}

/// Halves rows and columns until few are left. A coarse node lies on every other fine one; if their number is
/// even, one coarse node lies beyond the last.
void Hierarchy::build_sheet(const ClothModel& cloth)
{
    constexpr std::int32_t few = 3;
    auto rows = static_cast<std::int32_t>(cloth.shape.sheet->rows),
         columns = static_cast<std::int32_t>(cloth.shape.sheet->columns);
    std::int32_t planes = cloth.limits.bends_by_constraints() ? bent_sheet_planes : sheet_planes;
    if (cloth.plan.is_second_order()) history_plane = std::exchange(planes, planes + history_planes);
    append_level(rows, columns, planes);
    do {
        rows = rows / 2 + 1;
        columns = columns / 2 + 1;
        append_level(rows, columns, level_planes);
    } while (rows > few || columns > few);
}

/// One flag for each row of a sheet's level, or for each group of a mesh's nodes and edges.
void Hierarchy::append_live_flags()
{
    const auto append = [this](std::int32_t count) {
        const auto first = static_cast<std::int32_t>(number_count);
        number_count += static_cast<std::size_t>(count);
        return first;
    };
    for (SolverLevel& level : levels) {
        level.live = append(level.node_units());
        level.live_edges = append(sum_groups(level.edges));
    }
}

/// The paper's solver: only the cloth's level, and patterns over its springs.
void Hierarchy::build_rows(const ClothModel& cloth)
{
    const bool sheet = cloth.plan.on_grid;
    append_level(sheet ? static_cast<std::int32_t>(cloth.shape.sheet->rows) : 1,
                 static_cast<std::int32_t>(sheet ? cloth.shape.sheet->columns : cloth.node_count()),
                 paper_planes);
    constraints = ConstraintRows(cloth, number_count);
    topology = std::move(constraints.topology);
    number_count += constraints.number_count();
}

}  // namespace pliant
