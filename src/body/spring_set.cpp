#include "body/spring_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "body/bending.hpp"
#include "body/renumbering.hpp"

namespace pliant {
namespace {

double distance(Vec3d a, Vec3d b) { return std::sqrt(dot(b - a, b - a)); }

}  // namespace

SpringSet::SpringSet(const Cloth& cloth, const SteppingPlan& plan, ClothShape& shape)
{
    const Springs& given = cloth.springs;
    const RestScales scales{given.structural.rest_scale, given.shear.rest_scale, given.bend.rest_scale};
    if (shape.is_sheet()) {
        set_rest_lengths(*shape.sheet, scales);
        if (!plan.node_centric) list_sheet(*shape.sheet);
    } else {
        list_mesh(shape, scales);
    }
    if (plan.graded) grade(cloth, shape);
    if (!plan.node_centric) list_neighbours(shape.positions.size());
    if (shape.is_sheet()) {
        const SheetShape& sheet = *shape.sheet;
        count = sheet.spring_count();
        measured_count = sheet.measured_spring_count();
        shortest = *std::min_element(sheet.rest_lengths.begin(), sheet.rest_lengths.end());
    } else {
        count_list();
    }
    measure(shape, scales[0]);
}

SpringSet::SpringSet(std::vector<Spring> springs, Ragged<Neighbour> rows)
    : list(std::move(springs)), neighbours(std::move(rows))
{
    count_list();
}

void SpringSet::count_list()
{
    count = list.size();
    measured_count =
        static_cast<std::uint64_t>(std::count_if(list.begin(), list.end(), [](const Spring& spring) {
            return spring.spring_class != SpringClass::bend;
        }));
    shortest = std::numeric_limits<double>::infinity();
    for (const Spring& spring : list) shortest = std::min(shortest, spring.rest_length);
}

/// How long the cloth is, and how many springs lead from one end to the other.
void SpringSet::measure(const ClothShape& shape, double structural_scale)
{
    if (shape.is_sheet()) {
        const SheetShape& sheet = *shape.sheet;
        length_across = std::max((sheet.columns - 1) * sheet.spacing[0], (sheet.rows - 1) * sheet.spacing[1]);
        across = std::max(sheet.rows, sheet.columns) - 1;
        return;
    }
    double length = 0;
    std::size_t edges = 0;
    for (const Spring& spring : list)
        if (spring.spring_class == SpringClass::structural)
            length += spring.rest_length / structural_scale, ++edges;
    const double side = shape.longest_side();
    if (!(length > 0) || !(side > 0)) return;
    length_across = side;
    across = side / std::min(side, length / static_cast<double>(edges));
}

/// Gives springs individual parameters.
void SpringSet::grade(const Cloth& cloth, ClothShape& shape)
{
    const bool quadratic = cloth.springs.bend_model == BendModel::quadratic;
    const double bending = quadratic ? cloth.springs.bending_stiffness : 0;
    if (!shape.is_sheet()) {
        spectrum_end = 6.2;
        return add_bending(list, shape.triangles(), shape.positions, bending);
    }
    if (quadratic) spectrum_end = 4.2;
    if (std::get<SheetOptions>(cloth.shape).border == SheetBorder::half) halve_border(list, *shape.sheet);
    add_bending(list, *shape.sheet, bending);
    shape.become_mesh();
}

void SpringSet::set_rest_lengths(SheetShape& sheet, const RestScales& scales) const
{
    const auto [dx, dz] = sheet.spacing;
    const auto [structural, shear, bend] = scales;
    sheet.rest_lengths = {dx * structural, dz * structural, std::sqrt(dx * dx + dz * dz) * shear,
                          2 * dx * bend, 2 * dz * bend};
}

void SpringSet::list_sheet(const SheetShape& sheet)
{
    // Forward neighbours are visited in ascending order for any number of columns, so the list is sorted by
    // (i, j).
    list.reserve(sheet.spring_count());
    for_each_sheet_spring(sheet, [&](std::uint32_t i, std::uint32_t j, const SheetNeighbour& n) {
        list.push_back({i, j, n.spring_class, sheet.rest_lengths[static_cast<std::size_t>(n.rest)]});
    });
}

void SpringSet::list_mesh(const ClothShape& shape, const RestScales& scales)
{
    using Pair = std::pair<std::uint32_t, std::uint32_t>;
    const auto ordered = [](std::uint32_t a, std::uint32_t b) { return a < b ? Pair{a, b} : Pair{b, a}; };

    // Edges with their opposite vertices; sorted, so that all that follows has a fixed order.
    std::vector<std::pair<Pair, std::uint32_t>> sides;
    sides.reserve(shape.triangles().size() * 3);
    for (const Triangle& t : shape.triangles())
        for (std::size_t k = 0; k < 3; ++k)
            if (t[k] != t[(k + 1) % 3]) sides.emplace_back(ordered(t[k], t[(k + 1) % 3]), t[(k + 2) % 3]);
    std::sort(sides.begin(), sides.end());

    std::vector<Pair> edges, bends;
    for (std::size_t s = 0; s < sides.size(); ++s) {
        if (s == 0 || sides[s].first != sides[s - 1].first)
            edges.push_back(sides[s].first);
        else if (sides[s].second != sides[s - 1].second)
            bends.push_back(ordered(sides[s].second, sides[s - 1].second));
    }
    std::sort(bends.begin(), bends.end());
    bends.erase(std::unique(bends.begin(), bends.end()), bends.end());

    const auto at = [&](std::uint32_t node) { return to_double(shape.positions[node]); };
    const auto add = [&](Pair pair, SpringClass spring_class) {
        const double length = distance(at(pair.first), at(pair.second));
        const double scale = scales[static_cast<std::size_t>(spring_class)];
        if (length > 0) list.push_back({pair.first, pair.second, spring_class, length * scale});
    };
    for (const Pair& pair : edges) add(pair, SpringClass::structural);
    for (const Pair& pair : bends)
        if (!std::binary_search(edges.begin(), edges.end(), pair)) add(pair, SpringClass::bend);
    std::sort(list.begin(), list.end(), by_ends);
}

void SpringSet::list_neighbours(std::size_t node_count)
{
    neighbours.start.assign(node_count + 1, 0);
    for (const Spring& spring : list) {
        ++neighbours.start[spring.i + 1];
        ++neighbours.start[spring.j + 1];
    }
    for (std::size_t i = 0; i < node_count; ++i) neighbours.start[i + 1] += neighbours.start[i];
    neighbours.entries.resize(list.size() * 2);
    std::vector<std::uint32_t> next(neighbours.start.begin(), neighbours.start.end() - 1);
    for (std::uint32_t s = 0; s < list.size(); ++s) {
        neighbours.entries[next[list[s].i]++] = {list[s].j, s};
        neighbours.entries[next[list[s].j]++] = {list[s].i, s};
    }
    for (std::size_t i = 0; i < node_count; ++i)
        std::sort(neighbours.entries.begin() + neighbours.start[i],
                  neighbours.entries.begin() + neighbours.start[i + 1],
                  [](const Neighbour& a, const Neighbour& b) { return a.node < b.node; });
}

void SpringSet::renumber(std::span<const std::uint32_t> order, std::span<const std::uint32_t> node_of_vertex)
{
    // Springs are sorted by their first node and computed from the lower to the higher one; either direction
    // gives the same bits. A node still adds its springs in the order of the mesh's vertices.
    std::vector<std::uint32_t> springs_in_order(list.size());
    for (std::uint32_t s = 0; s < list.size(); ++s) {
        Spring& spring = list[s];
        const auto [i, j] = std::minmax(node_of_vertex[spring.i], node_of_vertex[spring.j]);
        spring.i = i;
        spring.j = j;
        springs_in_order[s] = s;
    }
    std::sort(springs_in_order.begin(), springs_in_order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return by_ends(list[a], list[b]); });
    reorder(list, springs_in_order);
    const std::vector<std::uint32_t> place_of_spring = inverse_of(springs_in_order);
    reorder_rows(neighbours, order);
    for (Neighbour& neighbour : neighbours.entries)
        neighbour = {node_of_vertex[neighbour.node], place_of_spring[neighbour.spring]};
}

std::uint32_t SpringSet::append(const SpringSet& other, std::uint32_t first_node)
{
    const auto first_spring = static_cast<std::uint32_t>(list.size());
    for (const Spring& s : other.list)
        list.push_back({s.i + first_node, s.j + first_node, s.spring_class, s.rest_length});
    count += other.count;
    measured_count += other.measured_count;
    shortest = std::min(shortest, other.shortest);
    return append_rows(neighbours, other.neighbours, [&](Neighbour n) {
        return Neighbour{n.node + first_node, n.spring + first_spring};
    });
}

}  // namespace pliant
