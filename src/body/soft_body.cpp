#include "body/soft_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "body/cloth_model.hpp"
#include "body/renumbering.hpp"

namespace pliant {
namespace {

/// Appends the blocks of `count` nodes or fans of one body, beginning at `first`.
void append_blocks(std::vector<BodyBlock>& blocks, std::uint32_t first, std::uint32_t count,
                   std::uint32_t body)
{
    constexpr std::uint32_t size = BodyBlock::most;
    for (std::uint32_t k = 0; k < count; k += size)
        blocks.push_back({first + k, std::min(size, count - k), body});
}

double length_of(Vec3d a) { return std::sqrt(dot(a, a)); }

/// The springs of a body, and where in a node's neighbours those across the inside begin.
std::pair<SpringSet, std::vector<std::uint32_t>> body_springs(const BodyOptions& options,
                                                              const ClothShape& shape,
                                                              const Ragged<std::uint32_t>& rings)
{
    const std::vector<Vec3>& positions = shape.positions;
    std::vector<Spring> springs;
    const auto add = [&](std::uint32_t i, std::uint32_t j, SpringClass spring_class) {
        const Vec3d d = to_double(positions[j]) - to_double(positions[i]);
        springs.push_back({i, j, spring_class, length_of(d)});
    };
    for (std::uint32_t i = 0; i < rings.row_count(); ++i)
        for (const std::uint32_t j : rings.row(i))
            if (i < j) add(i, j, SpringClass::structural);
    std::sort(springs.begin(), springs.end(), by_ends);
    const auto edge_count = static_cast<std::ptrdiff_t>(springs.size());
    const auto is_edge = [&](std::uint32_t i, std::uint32_t j) {
        return std::binary_search(springs.begin(), springs.begin() + edge_count, Spring{i, j}, by_ends);
    };
    for (const auto& [i, j] : internal_pairs(positions, shape.triangles(), options.internal))
        if (!is_edge(i, j)) add(i, j, SpringClass::shear);
    std::sort(springs.begin(), springs.end(), by_ends);

    std::vector<std::vector<Neighbour>> inside(positions.size());
    for (std::uint32_t s = 0; s < springs.size(); ++s) {
        if (springs[s].spring_class != SpringClass::shear) continue;
        inside[springs[s].i].push_back({springs[s].j, s});
        inside[springs[s].j].push_back({springs[s].i, s});
    }
    const auto spring_between = [&](std::uint32_t i, std::uint32_t j) {
        const Spring wanted{std::min(i, j), std::max(i, j)};
        return static_cast<std::uint32_t>(std::lower_bound(springs.begin(), springs.end(), wanted, by_ends) -
                                          springs.begin());
    };
    Ragged<Neighbour> neighbours;
    std::vector<std::uint32_t> links;
    neighbours.start.push_back(0);
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        for (const std::uint32_t j : rings.row(i)) neighbours.entries.push_back({j, spring_between(i, j)});
        links.push_back(static_cast<std::uint32_t>(neighbours.entries.size()));
        neighbours.entries.insert(neighbours.entries.end(), inside[i].begin(), inside[i].end());
        neighbours.start.push_back(static_cast<std::uint32_t>(neighbours.entries.size()));
    }
    return {SpringSet(std::move(springs), std::move(neighbours)), std::move(links)};
}

/// By node: where the volume constraint moves it, by a focus or as given; empty where all are 1.
std::vector<float> weights_of(const Cloth& cloth, const ClothShape& shape)
{
    const VolumeOptions& options = cloth.body->volume;
    if (!options.focus && options.weights.empty()) return {};
    const auto& mesh = std::get<SurfaceMesh>(cloth.shape);
    const VertexPlacement placed(cloth);
    std::vector<float> weights(mesh.vertices.size());
    for (std::uint32_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) {
        float& weight = weights[shape.node(vertex)];
        if (const auto& focus = options.focus) {
            const double d =
                std::min(1.0, length_of(placed(mesh.vertices[vertex]) - focus->centre) / focus->radius);
            weight = static_cast<float>(0.5 * (std::cos(std::numbers::pi * d) + 1));
        } else {
            weight = options.weights[vertex];
        }
    }
    return weights;
}

/// 1 / sum of the weights of free nodes; 0 where all weights are 1.
double inverse_weight_of(const Cloth& cloth, const SteppingPlan& plan, std::span<const float> weights,
                         const NodeMasses& masses)
{
    if (weights.empty()) return 0;
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i)
        if (masses.inverse(i) > 0) sum += double{weights[i]};
    if (!(sum > 0) && plan.keeps_volume())
        throw Error(ErrorKind::bad_input,
                    "body '" + cloth.name +
                        "': no free vertex has a weight above 0, so that nothing could keep its "
                        "volume; move or widen volume.focus, or give other weights");
    return sum > 0 ? 1 / sum : 0;
}

/// Forces and torques of regions, summed by node: f = F / n + tau x (x - c) / sum r^2, with r the distance of
/// a node from the axis of tau through the centre c. Their torque is the given one as long as the nodes turn
/// about that axis.
std::vector<LoadedNode> loads_of(const Cloth& cloth, const ClothShape& shape, const NodeMasses& masses)
{
    const std::vector<Vec3>& positions = shape.positions;
    std::vector<LoadedNode> by_node(positions.size());
    std::vector<bool> loaded(positions.size(), false);
    for (std::size_t k = 0; k < cloth.body->forces.size(); ++k) {
        const RegionForce& given = cloth.body->forces[k];
        std::vector<std::uint32_t> nodes;
        Vec3d middle{};
        for (std::uint32_t i = 0; i < positions.size(); ++i) {
            const Vec3d p = to_double(positions[i]) + shape.origin;
            const Vec3d &least = given.box.min, &most = given.box.max;
            if (masses.inverse(i) > 0 && p.x >= least.x && p.x <= most.x && p.y >= least.y && p.y <= most.y &&
                p.z >= least.z && p.z <= most.z) {
                nodes.push_back(i);
                middle = middle + to_double(positions[i]);
            }
        }
        const std::string where = "body '" + cloth.name + "': forces[" + std::to_string(k) + "]";
        if (nodes.empty())
            throw Error(ErrorKind::bad_input,
                        where + " is a box that contains no free node; move or enlarge it");
        const double share = 1.0 / static_cast<double>(nodes.size());
        middle = middle * share;
        Vec3d turn{};
        if (const double torque = length_of(given.torque); torque > 0) {
            const Vec3d axis = given.torque * (1 / torque);
            double inertia = 0;
            for (const std::uint32_t i : nodes) {
                const Vec3d arm = cross(axis, to_double(positions[i]) - middle);
                inertia += dot(arm, arm);
            }
            if (!(inertia > 0))
                throw Error(
                    ErrorKind::bad_input,
                    where + ".torque has all its nodes on its axis, where none can turn; enlarge the box");
            turn = given.torque * (1 / inertia);
        }
        for (const std::uint32_t i : nodes) {
            by_node[i].torque = by_node[i].torque + turn;
            by_node[i].force = by_node[i].force + given.force * share - cross(turn, middle);
            loaded[i] = true;
        }
    }
    std::vector<LoadedNode> loads;
    for (std::uint32_t i = 0; i < positions.size(); ++i)
        if (loaded[i]) loads.push_back({i, by_node[i].force, by_node[i].torque});
    return loads;
}

}  // namespace

std::pair<SpringSet, BodyModel> make_soft_body(const Cloth& cloth, const SteppingPlan& plan,
                                               const ClothShape& shape, const NodeMasses& masses)
{
    const auto count = static_cast<std::uint32_t>(shape.positions.size());
    BodyModel body;
    BodyPart part;
    part.node_count = count;
    part.volume = sixfold_volume(shape.positions, shape.triangles()) / 6;
    part.options = cloth.body->volume;
    part.options.target = gradual_target(part.options.target);
    for (const Vec3& x : shape.positions) part.centre = part.centre + to_double(x) * (1.0 / count);
    body.has_pressure = std::any_of(part.options.pressure.begin(), part.options.pressure.end(),
                                    [](const TimedValue& p) { return p.value != 0; });

    const Ragged<std::uint32_t> rings = rings_of(count, shape.triangles());
    auto [springs, links] = body_springs(*cloth.body, shape, rings);
    body.links = std::move(links);
    body.fans = fans_of(rings);
    part.inverse_fans = 1.0 / static_cast<double>(body.fans.row_count());
    append_blocks(body.node_blocks, 0, count, 0);
    append_blocks(body.fan_blocks, 0, static_cast<std::uint32_t>(body.fans.row_count()), 0);
    part.block_count = static_cast<std::uint32_t>(body.node_blocks.size());
    part.fan_block_count = static_cast<std::uint32_t>(body.fan_blocks.size());
    body.weights = weights_of(cloth, shape);
    part.inverse_weight = inverse_weight_of(cloth, plan, body.weights, masses);
    body.parts.push_back(std::move(part));
    body.loads = loads_of(cloth, shape, masses);
    return {std::move(springs), std::move(body)};
}

bool ClothModel::can_take(const ClothModel& other) const
{
    if (!body || !other.body) return false;
    // Beyond this distance, in widths of the body, single precision would resolve it worse than from its own
    // origin.
    constexpr double far = 32;
    double width = 0;
    for (const Vec3& x : other.shape.positions)
        width = std::max(width, length_of(to_double(x) - to_double(other.shape.positions[0])));
    constexpr std::size_t most_nodes = 1u << 22;
    return parameters == other.parameters && plan.step == other.plan.step &&
           body->has_pressure == other.body->has_pressure &&
           length_of(other.shape.origin - shape.origin) <= far * width &&
           std::size_t{node_count()} + other.node_count() <= most_nodes;
}

void ClothModel::take(const ClothModel& other)
{
    const std::uint32_t node = node_count();
    const Vec3d shift = other.shape.origin - shape.origin;
    const std::uint32_t neighbour = springs.append(other.springs, node);
    attachments.append(other.attachments, node, shift);
    body->append(*other.body, node, other.node_count(), neighbour, shift);
    shape.append(other.shape, shift);
    masses.append(other.masses);
}

void BodyModel::append(const BodyModel& other, std::uint32_t node, std::uint32_t count,
                       std::uint32_t neighbour, Vec3d shift)
{
    if (!weights.empty() || !other.weights.empty()) {
        weights.resize(node, 1.0f);
        pliant::append(weights, other.weights);
        weights.resize(node + count, 1.0f);
    }
    for (const std::uint32_t link : other.links) links.push_back(link + neighbour);

    const auto fan = static_cast<std::uint32_t>(fans.row_count());
    const auto part = static_cast<std::uint32_t>(parts.size());
    const auto node_block = static_cast<std::uint32_t>(node_blocks.size());
    const auto fan_block = static_cast<std::uint32_t>(fan_blocks.size());
    append_rows(fans, other.fans, [&](std::uint32_t n) { return n + node; });
    for (const BodyBlock& b : other.node_blocks)
        node_blocks.push_back({b.first + node, b.count, b.body + part});
    for (const BodyBlock& b : other.fan_blocks) fan_blocks.push_back({b.first + fan, b.count, b.body + part});
    for (BodyPart p : other.parts) {
        p.first_node += node;
        p.first_block += node_block;
        p.first_fan_block += fan_block;
        p.centre = p.centre + shift;
        parts.push_back(std::move(p));
    }
    // f = F + tau x (p - shift) for a position p in our coordinates
    for (const LoadedNode& l : other.loads)
        loads.push_back({l.node + node, l.force - cross(l.torque, shift), l.torque});
}

}  // namespace pliant
