#include "body/node_masses.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "body/bending.hpp"
#include "body/collider_motion.hpp"
#include "body/renumbering.hpp"

namespace pliant {
namespace {

Vec3d at(const std::vector<Vec3>& positions, std::uint32_t node) { return to_double(positions[node]); }

double area(const std::vector<Vec3>& positions, const Triangle& t)
{
    const Vec3d n =
        cross(at(positions, t[1]) - at(positions, t[0]), at(positions, t[2]) - at(positions, t[0]));
    return 0.5 * std::sqrt(dot(n, n));
}

/// The nodes that a pin selects.
class PinnedNodes {
public:
    PinnedNodes(const ClothShape& shape) : shape_(shape) {}

    std::vector<std::uint32_t> operator()(std::uint32_t index) const { return {shape_.node(index)}; }
    std::vector<std::uint32_t> operator()(Corner corner) const
    {
        const std::uint32_t last_row = shape_.sheet->rows - 1, last_column = shape_.sheet->columns - 1;
        switch (corner) {
            case Corner::top_left: return {node(0, 0)};
            case Corner::top_right: return {node(0, last_column)};
            case Corner::bottom_left: return {node(last_row, 0)};
            case Corner::bottom_right: return {node(last_row, last_column)};
        }
        return {};
    }
    std::vector<std::uint32_t> operator()(Edge edge) const
    {
        const std::uint32_t rows = shape_.sheet->rows, columns = shape_.sheet->columns;
        const bool along_row = edge == Edge::top || edge == Edge::bottom;
        std::vector<std::uint32_t> nodes;
        for (std::uint32_t k = 0; k < (along_row ? columns : rows); ++k)
            nodes.push_back(edge == Edge::top      ? node(0, k)
                            : edge == Edge::bottom ? node(rows - 1, k)
                            : edge == Edge::left   ? node(k, 0)
                                                   : node(k, columns - 1));
        return nodes;
    }
    std::vector<std::uint32_t> operator()(const Region& region) const
    {
        std::vector<std::uint32_t> nodes;
        for (std::uint32_t i = 0; i < shape_.positions.size(); ++i) {
            const Vec3d p = at(shape_.positions, i) + shape_.origin;
            if (p.x >= region.min.x && p.x <= region.max.x && p.y >= region.min.y && p.y <= region.max.y &&
                p.z >= region.min.z && p.z <= region.max.z)
                nodes.push_back(i);
        }
        return nodes;
    }

private:
    std::uint32_t node(std::uint32_t row, std::uint32_t column) const
    {
        return row * shape_.sheet->columns + column;
    }
    const ClothShape& shape_;
};

}  // namespace

NodeMasses::NodeMasses(const Cloth& cloth, const ClothShape& shape)
{
    constexpr double default_density = 0.3;  // kg/m2, a heavy cotton
    const std::size_t count = shape.positions.size();
    std::vector<double> mass(count, 0.0);
    if (cloth.node_mass) {
        mass.assign(count, *cloth.node_mass);
    } else if (shape.is_sheet()) {
        const auto& options = std::get<SheetOptions>(cloth.shape);
        const double total = cloth.density.value_or(default_density) * options.width * options.height;
        mass.assign(count, total / static_cast<double>(count));
        if (options.border == SheetBorder::half) share_by_area(mass, total, *shape.sheet);
    } else {
        for (const Triangle& t : shape.triangles())
            for (const std::uint32_t node : t)
                mass[node] += cloth.density.value_or(default_density) * area(shape.positions, t) / 3;
        for (std::size_t i = 0; i < count; ++i)
            if (!(mass[i] > 0))
                throw Error(ErrorKind::bad_input, "the mesh of cloth '" + cloth.name + "': vertex " +
                                                      std::to_string(i) +
                                                      " belongs to no triangle with an area, so that its "
                                                      "mass would be 0; remove it from the "
                                                      "mesh, or give node_mass instead of density");
    }
    constexpr double least = 1e-18, most = 1e18;  // kg; beyond these a float has no accurate inverse
    for (std::size_t i = 0; i < count; ++i)
        if (!(mass[i] >= least && mass[i] <= most)) {
            char value[32];
            std::snprintf(value, sizeof value, "%.3g", mass[i]);
            throw Error(ErrorKind::bad_input, "cloth '" + cloth.name + "': node " + std::to_string(i) +
                                                  " has a mass of " + value +
                                                  " kg, and single precision can work with 1e-18 to 1e18 kg; "
                                                  "change density, node_mass or size");
        }
    mean = std::accumulate(mass.begin(), mass.end(), 0.0) / static_cast<double>(count);
    kg = std::move(mass);
    pinned.assign(count, false);
}

double NodeMasses::sum() const
{
    double sum = 0;
    for (const double m : kg) sum += m;
    return sum;
}

void NodeMasses::renumber(std::span<const std::uint32_t> order)
{
    reorder(kg, order);
    reorder(pinned, order);
}

void NodeMasses::append(const NodeMasses& other)
{
    pliant::append(kg, other.kg);
    pliant::append(pinned, other.pinned);
}

Attachments pin_nodes(const Cloth& cloth, ClothShape& shape, NodeMasses& masses)
{
    Attachments attachments;
    auto& [attached, motions] = attachments;
    const PinnedNodes nodes_of(shape);
    for (std::size_t p = 0; p < cloth.pins.size(); ++p) {
        const std::vector<std::uint32_t> nodes = std::visit(nodes_of, cloth.pins[p].where);
        if (nodes.empty())
            throw Error(ErrorKind::bad_input,
                        "cloth '" + cloth.name + "': pins[" + std::to_string(p) +
                            "] is a box that contains no node of the cloth; move or enlarge it");
        for (const std::uint32_t node : nodes) {
            masses.pinned[node] = true;
            shape.velocities[node] = {};
        }
        if (cloth.pins[p].keyframes.empty()) continue;
        Vec3d centre{};  // relative to the origin of the model, as positions are
        for (const std::uint32_t node : nodes)
            centre = centre + at(shape.positions, node) * (1.0 / static_cast<double>(nodes.size()));
        for (const std::uint32_t node : nodes)
            attached.push_back(
                {node, static_cast<std::uint32_t>(motions.size()), at(shape.positions, node) - centre});
        motions.push_back({centre, cloth.pins[p].keyframes});
    }
    // If several moving pins hold a node, it follows the last of them.
    std::stable_sort(attached.begin(), attached.end(),
                     [](const AttachedNode& a, const AttachedNode& b) { return a.node < b.node; });
    const auto last_of_node =
        std::unique(attached.rbegin(), attached.rend(),
                    [](const AttachedNode& a, const AttachedNode& b) { return a.node == b.node; });
    attached.erase(attached.begin(), last_of_node.base());
    return attachments;
}

void Attachments::place(double time, std::span<Vec3> places) const
{
    std::vector<RigidMotion> now;
    for (const AttachmentMotion& motion : motions) now.push_back(motion_at(motion.keyframes, time));
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const RigidMotion& motion = now[nodes[k].motion];
        places[k] =
            to_float(motions[nodes[k].motion].centre + motion.offset + rotate(motion.rotation, nodes[k].arm));
    }
}

void Attachments::renumber(std::span<const std::uint32_t> node_of_vertex)
{
    for (AttachedNode& a : nodes) a.node = node_of_vertex[a.node];
    std::sort(nodes.begin(), nodes.end(),
              [](const AttachedNode& a, const AttachedNode& b) { return a.node < b.node; });
}

void Attachments::append(const Attachments& other, std::uint32_t first_node, Vec3d shift)
{
    const auto motion = static_cast<std::uint32_t>(motions.size());
    for (const AttachedNode& a : other.nodes)
        nodes.push_back({a.node + first_node, a.motion + motion, a.arm});
    for (const AttachmentMotion& m : other.motions) motions.push_back({m.centre + shift, m.keyframes});
}

}  // namespace pliant
