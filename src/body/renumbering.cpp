// Renumbers the nodes of a mesh so that neighbours are close in memory, whatever the order in its file.
#include <algorithm>
#include <utility>

#include "body/cloth_model.hpp"

namespace pliant {
namespace {

/// Permutes values of nodes into the order `order`.
template <class Value>
void reorder(std::vector<Value>& values, std::span<const std::uint32_t> order)
{
    std::vector<Value> before = std::exchange(values, std::vector<Value>(values.size()));
    for (std::size_t node = 0; node < order.size(); ++node) values[node] = before[order[node]];
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

}  // namespace

void ClothModel::renumber(const std::vector<std::uint32_t>& order)
{
    node_of_vertex.resize(order.size());
    for (std::uint32_t node = 0; node < order.size(); ++node) node_of_vertex[order[node]] = node;
    reorder(positions, order);
    reorder(velocities, order);
    reorder(masses, order);
    reorder(pinned, order);
    for (AttachedNode& a : attached) a.node = node_of_vertex[a.node];
    std::sort(attached.begin(), attached.end(),
              [](const AttachedNode& a, const AttachedNode& b) { return a.node < b.node; });
    for (Triangle& triangle : triangles_)
        for (std::uint32_t& node : triangle) node = node_of_vertex[node];
    reorder_rows(node_triangles, order);

    // Springs are sorted by their first node and computed from the lower to the higher one; either direction
    // gives the same bits. A node still adds its springs in the order of the mesh's vertices.
    std::vector<std::uint32_t> springs_in_order(springs.size());
    for (std::uint32_t s = 0; s < springs.size(); ++s) {
        Spring& spring = springs[s];
        const auto [i, j] = std::minmax(node_of_vertex[spring.i], node_of_vertex[spring.j]);
        spring.i = i;
        spring.j = j;
        springs_in_order[s] = s;
    }
    std::sort(springs_in_order.begin(), springs_in_order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const Spring &p = springs[a], &q = springs[b];
        return p.i != q.i ? p.i < q.i : p.j < q.j;
    });
    reorder(springs, springs_in_order);
    std::vector<std::uint32_t> place_of_spring(springs.size());
    for (std::uint32_t s = 0; s < springs.size(); ++s) place_of_spring[springs_in_order[s]] = s;
    reorder_rows(neighbours, order);
    for (Neighbour& neighbour : neighbours.entries)
        neighbour = {node_of_vertex[neighbour.node], place_of_spring[neighbour.spring]};
}

}  // namespace pliant
