#include "backend/cpu/mesh_tables.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "kernels/planes.hpp"

namespace pliant::cpu {
namespace {

constexpr std::int32_t lanes = LaneTable::lanes;
/// Adding it changes nothing, not even -0: a block of -0 times a difference of 0 is -0, and so is 0 times -0.
constexpr float nothing = -0.0f;

std::int32_t whole_slices(std::int32_t count) { return (count + lanes - 1) / lanes * lanes; }

/// The block of a level that couples nothing (Hierarchy::append_mesh_level).
std::int32_t empty_block(const SolverLevel& level) { return level.edges + level.columns; }

/// 1 if the node is the first end of its spring to the neighbour, -1 if the second.
float side_of(std::int32_t node, std::int32_t neighbour) { return neighbour < node ? -1.0f : 1.0f; }

}  // namespace

const std::int32_t* MeshTables::keep(std::vector<std::int32_t> integers)
{
    return integers_.emplace_back(std::move(integers)).data();
}
float* MeshTables::keep(std::vector<float> numbers)
{
    AlignedArray<float>& kept = numbers_.emplace_back(numbers.size());
    std::copy(numbers.begin(), numbers.end(), kept.data());
    return kept.data();
}

MeshTables::MeshTables(const Hierarchy& hierarchy, SolverState<float>& solver) : hierarchy_(&hierarchy)
{
    if (hierarchy.empty() || hierarchy.topology.empty() || hierarchy.levels.size() < 2) return;
    for (std::size_t k = 0; k < hierarchy.levels.size(); ++k) {
        const SolverLevel& level = hierarchy.levels[k];
        MeshLanes& of = levels_.emplace_back();
        add_nodes(of, level);
        if (k == 0)
            add_springs(of, level);
        else
            add_transfers(of, level, hierarchy.levels[k - 1]);
        solver.put<float>(static_cast<std::size_t>(level.edge_base + 6 * empty_block(level)),
                          std::vector<float>(6, nothing));
    }
    solver.set_lanes(levels_.data());
}

std::size_t MeshTables::record_groups(const Call& call) const
{
    const std::size_t number = call.pass == Pass::mesh_restrict ? call.level - 1 : call.level;
    return static_cast<std::size_t>(sum_groups(hierarchy_->levels[number].columns));
}

MeshTables::Table MeshTables::make_table(std::int32_t count,
                                         const std::function<void(std::int32_t, Row&)>& row_of,
                                         const std::function<Entry(std::int32_t)>& filler)
{
    std::vector<std::int32_t> start, rows, place, edges;
    std::vector<float> weight;
    std::int32_t next = 0;
    Row slice[lanes];
    for (std::int32_t first = 0; first < count; first += lanes) {
        start.push_back(next);
        for (std::int32_t lane = 0; lane < lanes; ++lane) {
            slice[lane].clear();
            if (first + lane < count) row_of(first + lane, slice[lane]);
        }
        std::size_t longest = 0;
        for (std::int32_t lane = 0; lane < lanes; lane += LaneTable::counted) {
            std::size_t longest_of = 0;
            for (std::int32_t k = 0; k < LaneTable::counted; ++k)
                longest_of = std::max(longest_of, slice[lane + k].size());
            rows.push_back(static_cast<std::int32_t>(longest_of));
            longest = std::max(longest, longest_of);
        }
        for (std::size_t k = 0; k < longest; ++k)
            for (std::int32_t lane = 0; lane < lanes; ++lane) {
                const Entry entry = k < slice[lane].size() ? slice[lane][k] : filler(first + lane);
                place.push_back(entry.place);
                weight.push_back(entry.weight);
                edges.push_back(entry.edge);
            }
        next += static_cast<std::int32_t>(longest);
    }
    Table table;
    table.lanes.start = keep(std::move(start));
    table.lanes.rows = keep(std::move(rows));
    table.lanes.place = keep(std::move(place));
    table.lanes.weight = keep(std::move(weight));
    table.edges = keep(std::move(edges));
    return table;
}

template <class Function>
void MeshTables::for_each_pair(std::int32_t start, std::int32_t row, const Function& function) const
{
    const auto topology = [&](std::int32_t k) { return hierarchy_->topology[static_cast<std::size_t>(k)]; };
    for (std::int32_t k = topology(start + row); k < topology(start + row + 1); k += 2)
        function(topology(k), topology(k + 1));
}

void MeshTables::add_nodes(MeshLanes& of, const SolverLevel& level)
{
    const std::int32_t first = Hierarchy::offset(level, 0, 0);
    const Table table = make_table(
        level.columns,
        [&](std::int32_t node, Row& row) {
            for_each_pair(level.row_start, node, [&](std::int32_t other, std::int32_t edge) {
                const std::int32_t neighbour = other - first;
                row.push_back({MeshLanes::vector_size * neighbour, side_of(node, neighbour), 2 * edge});
            });
        },
        [&](std::int32_t node) {
            return Entry{MeshLanes::vector_size * node, 1, 2 * empty_block(level)};
        });
    of.neighbours = table.lanes;
    of.neighbour_edges = table.edges;
    std::size_t row_count = 0;
    for (std::int32_t k = 0; k < whole_slices(level.columns); k += lanes) {
        const std::int32_t* rows = of.neighbours.rows + k / LaneTable::counted;
        row_count += static_cast<std::size_t>(*std::max_element(rows, rows + lanes / LaneTable::counted));
    }
    of.couplings = keep(std::vector<float>(6 * lanes * row_count));
    const auto node_places = static_cast<std::size_t>(whole_slices(level.columns) + lanes);
    of.vectors = keep(std::vector<float>(MeshLanes::vector_size * node_places));
}

void MeshTables::add_springs(MeshLanes& of, const SolverLevel& level)
{
    const std::int32_t first = Hierarchy::offset(level, 0, 0);
    const auto node_places = static_cast<std::size_t>(whole_slices(level.columns) + lanes);
    of.states = keep(std::vector<float>(MeshLanes::state_size * node_places));
    const auto springs_by_node = [&](std::int32_t table_start) {
        return make_table(
                   level.columns,
                   [&](std::int32_t node, Row& row) {
                       for_each_pair(table_start, node, [&](std::int32_t other, std::int32_t edge) {
                           row.push_back({2 * edge, side_of(node, other - first)});
                       });
                   },
                   [&](std::int32_t) {
                       return Entry{2 * empty_block(level), 1};
                   })
            .lanes;
    };
    of.held = springs_by_node(level.held_start);
    of.loose = springs_by_node(level.loose_start);
    if (level.folds())  // without the spring itself, which is the first entry
        of.folds =
            make_table(
                level.loose,
                [&](std::int32_t edge, Row& row) {
                    for_each_pair(level.fold_start, edge, [&](std::int32_t source, std::int32_t weight) {
                        if (source != edge) row.push_back({2 * source, std::bit_cast<float>(weight)});
                    });
                },
                [&](std::int32_t) {
                    return Entry{2 * empty_block(level), nothing};
                })
                .lanes;
    const auto size = static_cast<std::size_t>(whole_slices(level.edges));
    std::vector<std::int32_t> ends[2] = {std::vector<std::int32_t>(size), std::vector<std::int32_t>(size)};
    std::vector<float> classes(size);
    bool has_class[3]{};
    for (std::size_t e = 0; e < static_cast<std::size_t>(level.edges); ++e) {
        const std::int32_t* edge =
            hierarchy_->topology.data() + static_cast<std::size_t>(level.edge_ends) + 3 * e;
        for (std::size_t k = 0; k < 2; ++k) ends[k][e] = MeshLanes::state_size * (edge[k] - first);
        classes[e] = static_cast<float>(edge[2]);
        has_class[edge[2]] = true;
    }
    std::vector<std::int32_t> class_of_group(static_cast<std::size_t>(sum_groups(level.edges)), -1);
    for (std::size_t group = 0; group < class_of_group.size(); ++group) {
        const auto begin = classes.begin() + static_cast<std::ptrdiff_t>(group * sum_columns);
        const auto end =
            classes.begin() + std::min<std::ptrdiff_t>((begin - classes.begin()) + sum_columns, level.edges);
        if (std::all_of(begin, end, [&](float k) { return k == *begin; }))
            class_of_group[group] = static_cast<std::int32_t>(*begin);
    }
    of.class_of_group = keep(std::move(class_of_group));
    for (int k = 0; k < 3; ++k)
        if (has_class[k]) of.classes[of.class_count++] = k;
    of.first_end = keep(std::move(ends[0]));
    of.second_end = keep(std::move(ends[1]));
    of.spring_class = keep(std::move(classes));
}

/// A table of the rows in `order`, of pairs (place, weight); a place is stored as factor (place - offset).
LaneTable MeshTables::weighted(std::int32_t count, std::int32_t start, const std::vector<std::int32_t>& order,
                               std::int32_t offset, std::int32_t factor, std::int32_t filler)
{
    return make_table(
               count,
               [&](std::int32_t k, Row& row) {
                   const std::int32_t from = order.empty() ? k : order[static_cast<std::size_t>(k)];
                   for_each_pair(start, from, [&](std::int32_t place, std::int32_t weight) {
                       row.push_back({factor * (place - offset), std::bit_cast<float>(weight)});
                   });
               },
               [&](std::int32_t) {
                   return Entry{filler, nothing};
               })
        .lanes;
}

void MeshTables::add_transfers(MeshLanes& of, const SolverLevel& level, const SolverLevel& finer)
{
    of.parents = weighted(finer.columns, level.parents_start, {}, Hierarchy::offset(level, 0, 0),
                          MeshLanes::vector_size, MeshLanes::vector_size * whole_slices(level.columns));
    // A zero record follows the nodes, and an empty block the blocks.
    of.children =
        weighted(level.columns, level.children_start, {}, Hierarchy::offset(finer, 0, 0), 1, finer.columns);

    // Sorts edges by their number of sources, within the groups into which passes are divided.
    std::vector<std::int32_t> order(static_cast<std::size_t>(level.edges));
    std::iota(order.begin(), order.end(), 0);
    const auto source_count = [&](std::int32_t e) {
        const std::int32_t* start = hierarchy_->topology.data() + level.coupling_start + e;
        return start[1] - start[0];
    };
    for (auto group = order.begin(); group != order.end();) {
        const auto end = group + std::min<std::ptrdiff_t>(sum_columns, order.end() - group);
        std::stable_sort(group, end,
                         [&](std::int32_t a, std::int32_t b) { return source_count(a) > source_count(b); });
        group = end;
    }
    of.sources = weighted(level.edges, level.coupling_start, order, 0, 2, 2 * empty_block(finer));
    order.resize(static_cast<std::size_t>(whole_slices(level.edges)));
    of.source_edges = keep(std::move(order));
}

}  // namespace pliant::cpu
