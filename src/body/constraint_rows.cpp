#include "body/constraint_rows.hpp"

#include <algorithm>
#include <string>

#include "body/cloth_model.hpp"
#include "body/node_layout.hpp"
#include "kernels/planes.hpp"
#include "pliant/error.hpp"

namespace pliant {
namespace {

/// Counts are stored as floats, the arena's only number type.
constexpr std::size_t most_springs = std::size_t{1} << 24;

bool may_be_constraint(const ClothModel& cloth, const Spring& spring)
{
    const LimitedSprings& of_class = cloth.limits.of_class[static_cast<std::size_t>(spring.spring_class)];
    // A spring between two pins cannot move, and would give an equation without an unknown.
    const bool held = !(cloth.masses.inverse(spring.i) > 0) && !(cloth.masses.inverse(spring.j) > 0);
    return of_class.exists && of_class.beyond > 0 && !held;
}

std::int32_t entry(std::size_t a) { return static_cast<std::int32_t>(a); }

}  // namespace

ConstraintRows::ConstraintRows(const ClothModel& cloth, std::size_t number_base)
    : topology(rows_header), first_number(number_base)
{
    const auto refuse_if = [&](bool too_large) {
        if (too_large)
            throw Error(ErrorKind::bad_input,
                        "a cloth of " + std::to_string(cloth.node_count()) + " nodes and " +
                            std::to_string(cloth.springs.list.size()) +
                            " springs is too large for the solver paper, which can count "
                            "2^24 springs and number 2^31 values; use fewer nodes or the "
                            "solver newton_multigrid");
    };
    refuse_if(cloth.springs.list.size() > most_springs);
    number_springs(cloth);
    list_nodes(cloth);
    list_matrix(cloth);
    place_numbers(cloth);
    constexpr std::size_t most_entries = 0x7fffffff;  // the largest entry of the topology
    refuse_if(topology.size() > most_entries || number_base + number_count_ > most_entries);
}

/// Records the present end of `topology` as the beginning of a table.
std::int32_t ConstraintRows::begin(int header_entry)
{
    return topology[static_cast<std::size_t>(header_entry)] = entry(topology.size());
}

void ConstraintRows::number_springs(const ClothModel& cloth)
{
    for (const bool wanted : {true, false}) {
        for (std::uint32_t s = 0; s < cloth.springs.list.size(); ++s) {
            const Spring& spring = cloth.springs.list[s];
            if (!cloth.limits.of_class[static_cast<std::size_t>(spring.spring_class)].exists) continue;
            if (may_be_constraint(cloth, spring) == wanted) spring_of_.push_back(s);
        }
        if (wanted) constraints = static_cast<std::uint32_t>(spring_of_.size());
    }
    springs = static_cast<std::uint32_t>(spring_of_.size());
    const NodeLayout layout(cloth.plan.on_grid ? cloth.shape.sheet->rows : 1,
                            cloth.plan.on_grid ? cloth.shape.sheet->columns : cloth.node_count());
    begin(rows_ends);
    for (const std::uint32_t s : spring_of_)
        for (const std::uint32_t node : {cloth.springs.list[s].i, cloth.springs.list[s].j})
            topology.push_back(entry(layout.offset(node)));
    begin(rows_classes);
    for (const std::uint32_t s : spring_of_)
        topology.push_back(entry(std::size_t(cloth.springs.list[s].spring_class)));
}

/// In the order in which list_step adds a node's springs.
void ConstraintRows::list_nodes(const ClothModel& cloth)
{
    constexpr std::int32_t none = -1;
    std::vector<std::int32_t> number_of(cloth.springs.list.size(), none);
    for (std::size_t s = 0; s < spring_of_.size(); ++s) number_of[spring_of_[s]] = entry(s);
    std::vector<std::int32_t> entries;
    entries.reserve(2 * spring_of_.size());
    begin(rows_node_start);
    for (std::uint32_t node = 0; node < cloth.node_count(); ++node) {
        topology.push_back(entry(entries.size()));
        for (const Neighbour& neighbour : cloth.springs.neighbours.row(node)) {
            const std::int32_t s = number_of[neighbour.spring];
            if (s != none) entries.push_back(2 * s + (node < neighbour.node ? 0 : 1));
        }
    }
    topology.push_back(entry(entries.size()));
    begin(rows_node_entries);
    topology.insert(topology.end(), entries.begin(), entries.end());
}

void ConstraintRows::list_matrix(const ClothModel& cloth)
{
    std::vector<std::int32_t> columns, row;
    const auto node_start = static_cast<std::size_t>(topology[rows_node_start]);
    const auto node_entries = static_cast<std::size_t>(topology[rows_node_entries]);
    begin(rows_matrix_start);
    for (std::uint32_t s = 0; s < constraints; ++s) {
        topology.push_back(entry(columns.size()));
        row.assign(1, entry(s));
        const Spring& spring = cloth.springs.list[spring_of_[s]];
        for (const std::uint32_t node : {spring.i, spring.j}) {
            if (!(cloth.masses.inverse(node) > 0)) continue;
            const auto first = static_cast<std::size_t>(topology[node_start + node]);
            const auto end = static_cast<std::size_t>(topology[node_start + node + 1]);
            for (std::size_t e = first; e < end; ++e) {
                const std::int32_t other = topology[node_entries + e] / 2;
                if (other < entry(constraints)) row.push_back(other);
            }
        }
        std::sort(row.begin(), row.end());
        columns.insert(columns.end(), row.begin(), std::unique(row.begin(), row.end()));
    }
    topology.push_back(entry(columns.size()));
    begin(rows_columns);
    topology.insert(topology.end(), columns.begin(), columns.end());
    matrix_size_ = columns.size();
}

void ConstraintRows::place_numbers(const ClothModel& cloth)
{
    const bool adaptive = cloth.plan.method == Method::acad;
    topology[rows_springs] = entry(springs);
    topology[rows_constraints] = entry(constraints);
    topology[rows_adaptive] = adaptive;
    topology[rows_compression] = adaptive && cloth.plan.acad.compression;
    topology[rows_unilateral] = adaptive && cloth.plan.acad.target == AcadTarget::threshold;

    numbers.assign(paper_values, 0.0);
    for (std::size_t k = 0; k < spring_class_count; ++k) {
        numbers[paper_stiffness + k] = cloth.parameters.stiffness[k];
        numbers[paper_damping + k] = cloth.parameters.spring_damping[k];
    }
    numbers[paper_tolerance] = cloth.plan.paper.tolerance;
    numbers[paper_compliance] = cloth.plan.paper.compliance;
    numbers[paper_activate] = cloth.plan.acad.activate_at;
    numbers[paper_deactivate] = cloth.plan.acad.deactivate_at.value_or(cloth.plan.acad.activate_at);
    for (const std::uint32_t s : spring_of_) numbers.push_back(cloth.springs.list[s].rest_length);

    std::size_t at = first_number;
    const auto take = [&](std::size_t count) {
        const std::size_t here = at;
        at += count;
        return entry(here);
    };
    topology[rows_values] = take(paper_values);
    topology[rows_base] = take(std::size_t{row_planes} * springs);
    topology[rows_size] = entry(springs);
    topology[rows_matrix] = take(matrix_size_);
    // Level 0 of the prefix sum is a plane of the springs.
    for (std::size_t count = constraints;; count = scan_blocks(scan_counts_.size() - 1)) {
        const std::size_t level = scan_counts_.size();
        scan_counts_.push_back(count);
        topology[rows_scan + 2 * level] =
            level == 0 ? topology[rows_base] + row_place * entry(springs) : take(count);
        topology[rows_scan + 2 * level + 1] = entry(count);
        if (count <= std::size_t{scan_block}) break;
    }
    topology[rows_scan_levels] = entry(scan_counts_.size());
    number_count_ = at - first_number;
}

std::size_t ConstraintRows::scan_blocks(std::size_t level) const
{
    return (scan_counts_[level] + scan_block - 1) / scan_block;
}

}  // namespace pliant
