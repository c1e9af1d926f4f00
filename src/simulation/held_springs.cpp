#include "simulation/held_springs.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "kernels/planes.hpp"

namespace pliant {
namespace {

std::size_t size_of(std::int32_t a) { return static_cast<std::size_t>(a); }

std::uint64_t key_of(std::uint32_t i, std::uint32_t j)
{
    return std::uint64_t{std::min(i, j)} << 32 | std::max(i, j);
}

/// The strain from which a constraint can hold a spring of a class; below -1 if none does.
double limit_of(const ClothModel& model, SpringClass of)
{
    const LimitedSprings& springs = model.limits.of_class[static_cast<std::size_t>(of)];
    if (!(springs.beyond > 0)) return -2;
    // With compression resisted, short springs count, too: the mark alone decides.
    return model.plan.method == Method::acad && model.plan.acad.compression ? -0.999 : springs.limit;
}

}  // namespace

HeldSprings::HeldSprings(const ClothModel& model, std::span<const SpringListing> springs,
                         std::span<const std::uint32_t> node_of_vertex)
{
    if (model.hierarchy.empty()) return;
    rows_ = model.plan.solver == Solver::paper;
    remembers_ = model.limits.remembers_any();
    marked_ = rows_ || model.plan.corrects_steps() || remembers_;
    for (const SpringListing& spring : springs) {
        const double limit = limit_of(model, static_cast<SpringClass>(spring.kind));
        const double least = limit > -1 ? spring.rest_length * (1 + limit) : -1;
        springs_.push_back({spring.i, spring.j, static_cast<float>(least), -1,
                            model.limits.remembers(static_cast<SpringClass>(spring.kind))});
    }
    if (!marked_) return;
    const std::vector<std::int32_t>& topology = model.hierarchy.topology;
    const SolverLevel& level = model.hierarchy.levels.front();
    const auto at = [&](int entry) {
        return static_cast<std::size_t>(topology[static_cast<std::size_t>(entry)]);
    };
    if (rows_) {
        first_ = at(rows_base) + row_mark * at(rows_size);
        count_ = at(rows_constraints);
        find_listed_marks(model, node_of_vertex, topology.data() + at(rows_ends), 2);
    } else if (level.edges > 0) {
        first_ = size_of(level.edge_base) + (remembers_ ? edge_slip : edge_mark) * size_of(level.edge_size);
        count_ = size_of(level.edges);
        find_listed_marks(model, node_of_vertex, topology.data() + level.edge_ends, 3);
    } else {
        first_ = size_of(level.base) + (remembers_ ? plane_slip : plane_mark) * size_of(level.size);
        count_ = (remembers_ ? 4 : 6) * size_of(level.size);
        find_sheet_marks(model);
    }
}

void HeldSprings::find_sheet_marks(const ClothModel& model)
{
    const SolverLevel& level = model.hierarchy.levels.front();
    const std::uint32_t columns = model.shape.sheet->columns;
    for (Row& spring : springs_) {
        const auto row = static_cast<std::int32_t>(spring.i / columns),
                   column = static_cast<std::int32_t>(spring.i % columns);
        const std::int32_t down = static_cast<std::int32_t>(spring.j / columns) - row,
                           right = static_cast<std::int32_t>(spring.j % columns) - column;
        const int k = std::find_if(std::begin(sheet_neighbours), std::end(sheet_neighbours),
                                   [&](const SheetNeighbour& n) {
                                       return n.row_offset == down && n.column_offset == right;
                                   })
                          ->number;
        if (remembers_ && k >= 4) continue;  // bend springs have no memory
        spring.mark = std::int64_t{k} * level.size + Hierarchy::offset(level, row, column);
    }
}

void HeldSprings::find_listed_marks(const ClothModel& model, std::span<const std::uint32_t> node_of_vertex,
                                    const std::int32_t* ends, std::size_t stride)
{
    const SolverLevel& level = model.hierarchy.levels.front();
    std::unordered_map<std::int32_t, std::uint32_t> vertex_at;
    for (std::uint32_t vertex = 0; vertex < model.node_count(); ++vertex) {
        const auto columns = static_cast<std::uint32_t>(level.columns);
        const std::uint32_t node = node_of_vertex.empty() ? vertex : node_of_vertex[vertex];
        vertex_at[Hierarchy::offset(level, static_cast<std::int32_t>(node / columns),
                                    static_cast<std::int32_t>(node % columns))] = vertex;
    }
    std::unordered_map<std::uint64_t, std::int64_t> mark_of;
    for (std::size_t s = 0; s < count_; ++s)
        mark_of[key_of(vertex_at.at(ends[stride * s]), vertex_at.at(ends[stride * s + 1]))] =
            static_cast<std::int64_t>(s);
    for (Row& spring : springs_) {
        const auto found = mark_of.find(key_of(spring.i, spring.j));
        if (found != mark_of.end()) spring.mark = found->second;
    }
}

void HeldSprings::read(PassRunner& runner, std::uint32_t model, std::span<const Vec3> positions,
                       std::span<const float> forces, std::vector<std::uint32_t>& held)
{
    held.assign(springs_.size(), 0);
    if (springs_.empty()) return;
    // A step of acad with nothing to solve leaves the marks of an earlier step; its forces are then 0.
    if (marked_) runner.solver_numbers(model, first_, count_, marks_);
    for (std::size_t s = 0; s < springs_.size(); ++s) {
        const Row& spring = springs_[s];
        if (remembers_ && spring.remembers) {
            held[s] = spring.least >= 0 && spring.mark >= 0 && marks_[std::size_t(spring.mark)] != 0 ? 1 : 0;
            continue;
        }
        if (spring.least < 0 ||
            (marked_ && !remembers_ && (spring.mark < 0 || marks_[std::size_t(spring.mark)] == 0)))
            continue;
        if (!rows_) {
            const Vec3d d = to_double(positions[spring.j]) - to_double(positions[spring.i]);
            const double least = double{spring.least};
            // Compliance lets a spring under force be slightly longer than its limit.
            if (!(forces[spring.i] > 0 && forces[spring.j] > 0 && std::sqrt(dot(d, d)) > least)) continue;
        }
        held[s] = 1;
    }
}

}  // namespace pliant
