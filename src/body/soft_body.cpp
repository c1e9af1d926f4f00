// A soft body as a cloth model, with its own order of nodes and its own origin, rings and fans.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "body/cloth_model.hpp"
#include "body/collider_motion.hpp"

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

/// The origin of a body's coordinates: near its middle, on a grid as wide as the body, so that equal bodies
/// at points of that grid are stepped with equal bits.
Vec3d origin_of(Vec3d least, Vec3d most)
{
    const double extent = std::max({most.x - least.x, most.y - least.y, most.z - least.z, 1e-30});
    const double grid = std::exp2(std::ceil(std::log2(extent)));
    const auto snapped = [&](double a) { return std::round(a / grid) * grid; };
    const Vec3d middle = (least + most) * 0.5;
    return {snapped(middle.x), snapped(middle.y), snapped(middle.z)};
}

double length_of(Vec3d a) { return std::sqrt(dot(a, a)); }

}  // namespace

void ClothModel::build_body(const Cloth& cloth, const Scene& scene)
{
    const auto& mesh = std::get<SurfaceMesh>(cloth.shape);
    const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
    require_closed(mesh, mesh.file.empty() ? cloth.name : mesh.file.string());

    const std::vector<std::uint32_t> order = node_order(mesh);
    node_of_vertex.resize(count);
    for (std::uint32_t node = 0; node < count; ++node) node_of_vertex[order[node]] = node;
    for (const Triangle& t : mesh.triangles)
        triangles_.push_back({node_of_vertex[t[0]], node_of_vertex[t[1]], node_of_vertex[t[2]]});

    const Rotation rotation = rotation_from_degrees(cloth.rotation);
    std::vector<Vec3d> places;
    places.reserve(count);
    Vec3d least{1e30, 1e30, 1e30}, most{-1e30, -1e30, -1e30};
    for (const std::uint32_t vertex : order) {
        const Vec3d p = cloth.position + rotate(rotation, to_double(mesh.vertices[vertex]) * cloth.scale);
        least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
        most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
        places.push_back(p);
    }
    origin = origin_of(least, most);
    for (const Vec3d p : places) positions.push_back(to_float(p - origin));
    list_node_triangles();

    body.emplace();
    BodyPart part;
    part.node_count = count;
    part.volume = sixfold_volume(positions, triangles_) / 6;
    part.options = cloth.body->volume;
    part.options.target = gradual_target(part.options.target);
    for (const Vec3& x : positions) part.centre = part.centre + to_double(x) * (1.0 / count);
    body->constrained = scene.method == Method::volume && cloth.body->volume.constraint;
    body->has_pressure = std::any_of(part.options.pressure.begin(), part.options.pressure.end(),
                                     [](const TimedValue& p) { return p.value != 0; });
    spring_list = scene.method == Method::mass_spring && cloth.formulation == Formulation::spring_list;

    const Ragged<std::uint32_t> rings = rings_of(count, triangles_);
    list_body_springs(*cloth.body, rings);
    body->fans = fans_of(rings);
    part.inverse_fans = 1.0 / static_cast<double>(body->fans.row_count());
    append_blocks(body->node_blocks, 0, count, 0);
    append_blocks(body->fan_blocks, 0, static_cast<std::uint32_t>(body->fans.row_count()), 0);
    part.block_count = static_cast<std::uint32_t>(body->node_blocks.size());
    part.fan_block_count = static_cast<std::uint32_t>(body->fan_blocks.size());

    if (const auto& focus = part.options.focus) {
        for (const Vec3d p : places) {
            const double d = std::min(1.0, length_of(p - focus->centre) / focus->radius);
            body->weights.push_back(static_cast<float>(0.5 * (std::cos(std::numbers::pi * d) + 1)));
        }
    } else if (!part.options.weights.empty()) {
        for (const std::uint32_t vertex : order) body->weights.push_back(part.options.weights[vertex]);
    }
    body->parts.push_back(std::move(part));
}

void ClothModel::finish_body(const Cloth& cloth)
{
    BodyPart& part = body->parts.front();
    if (!body->weights.empty()) {
        double sum = 0;
        for (std::size_t i = 0; i < positions.size(); ++i)
            if (inverse_mass(i) > 0) sum += double{body->weights[i]};
        if (!(sum > 0) && body->constrained)
            throw Error(ErrorKind::bad_input,
                        "body '" + cloth.name +
                            "': no free vertex has a weight above 0, so nothing can keep its "
                            "volume; move or widen volume.focus, or give other weights");
        part.inverse_weight = sum > 0 ? 1 / sum : 0;
    }
    set_loads(cloth);
}

void ClothModel::list_body_springs(const BodyOptions& options, const Ragged<std::uint32_t>& rings)
{
    const auto add = [&](std::uint32_t i, std::uint32_t j, SpringClass spring_class) {
        const Vec3d d = to_double(positions[j]) - to_double(positions[i]);
        springs.push_back({i, j, spring_class, length_of(d)});
    };
    const auto by_ends = [](const Spring& a, const Spring& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; };
    for (std::uint32_t i = 0; i < rings.row_count(); ++i)
        for (const std::uint32_t j : rings.row(i))
            if (i < j) add(i, j, SpringClass::structural);
    std::sort(springs.begin(), springs.end(), by_ends);
    const auto edge_count = static_cast<std::ptrdiff_t>(springs.size());
    const auto is_edge = [&](std::uint32_t i, std::uint32_t j) {
        return std::binary_search(springs.begin(), springs.begin() + edge_count, Spring{i, j}, by_ends);
    };
    for (const auto& [i, j] : internal_pairs(positions, triangles_, options.internal))
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
    neighbours.start.push_back(0);
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        for (const std::uint32_t j : rings.row(i)) neighbours.entries.push_back({j, spring_between(i, j)});
        body->links.push_back(static_cast<std::uint32_t>(neighbours.entries.size()));
        neighbours.entries.insert(neighbours.entries.end(), inside[i].begin(), inside[i].end());
        neighbours.start.push_back(static_cast<std::uint32_t>(neighbours.entries.size()));
    }
}

/// Forces and torques of regions, summed by node: f = F / n + tau x (x - c) / sum r^2, with r the distance of
/// a node from the axis of tau through the centre c. Their torque is the given one as long as the nodes turn
/// about that axis.
void ClothModel::set_loads(const Cloth& cloth)
{
    std::vector<LoadedNode> by_node(positions.size());
    std::vector<bool> loaded(positions.size(), false);
    for (std::size_t k = 0; k < cloth.body->forces.size(); ++k) {
        const RegionForce& given = cloth.body->forces[k];
        std::vector<std::uint32_t> nodes;
        Vec3d middle{};
        for (std::uint32_t i = 0; i < positions.size(); ++i) {
            const Vec3d p = to_double(positions[i]) + origin;
            const Vec3d &least = given.box.min, &most = given.box.max;
            if (inverse_mass(i) > 0 && p.x >= least.x && p.x <= most.x && p.y >= least.y && p.y <= most.y &&
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
    for (std::uint32_t i = 0; i < positions.size(); ++i)
        if (loaded[i]) body->loads.push_back({i, by_node[i].force, by_node[i].torque});
}

bool ClothModel::can_take(const ClothModel& other) const
{
    if (!body || !other.body) return false;
    // Beyond this distance, in widths of the body, single precision would resolve it worse than from its own
    // origin.
    constexpr double far = 32;
    double width = 0;
    for (const Vec3& x : other.positions)
        width = std::max(width, length_of(to_double(x) - to_double(other.positions[0])));
    constexpr std::size_t most_nodes = 1u << 22;
    return parameters == other.parameters && body->constrained == other.body->constrained &&
           body->has_pressure == other.body->has_pressure && spring_list == other.spring_list &&
           length_of(other.origin - origin) <= far * width &&
           positions.size() + other.positions.size() <= most_nodes;
}

void ClothModel::take(const ClothModel& other)
{
    const auto node = static_cast<std::uint32_t>(positions.size()),
               spring = static_cast<std::uint32_t>(springs.size());
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    /// Appends the rows of another body, with all entries shifted.
    const auto append_rows = [&](auto& to, const auto& from, auto moved) {
        const auto first = static_cast<std::uint32_t>(to.entries.size());
        for (std::size_t k = 1; k < from.start.size(); ++k) to.start.push_back(from.start[k] + first);
        for (const auto& entry : from.entries) to.entries.push_back(moved(entry));
        return first;
    };
    const Vec3d shift = other.origin - origin;
    BodyModel& ours = *body;
    const BodyModel& theirs = *other.body;

    const bool weighted = !ours.weights.empty() || !theirs.weights.empty();
    if (weighted && ours.weights.empty()) ours.weights.assign(positions.size(), 1.0f);
    append(ours.weights, theirs.weights);
    for (const Vec3& x : other.positions) positions.push_back(to_float(to_double(x) + shift));
    if (weighted) ours.weights.resize(positions.size(), 1.0f);
    append(velocities, other.velocities);
    append(masses, other.masses);
    append(pinned, other.pinned);

    const auto triangle = static_cast<std::uint32_t>(triangles_.size());
    for (const Triangle& t : other.triangles_) triangles_.push_back({t[0] + node, t[1] + node, t[2] + node});
    append_rows(node_triangles, other.node_triangles, [&](std::uint32_t t) { return t + triangle; });
    for (const Spring& s : other.springs)
        springs.push_back({s.i + node, s.j + node, s.spring_class, s.rest_length});
    const std::uint32_t neighbour = append_rows(neighbours, other.neighbours, [&](Neighbour n) {
        return Neighbour{n.node + node, n.spring + spring};
    });
    for (const std::uint32_t link : theirs.links) ours.links.push_back(link + neighbour);

    const auto motion = static_cast<std::uint32_t>(motions.size());
    for (const AttachedNode& a : other.attached)
        attached.push_back({a.node + node, a.motion + motion, a.arm});
    for (const AttachmentMotion& m : other.motions) motions.push_back({m.centre + shift, m.keyframes});

    const auto fan = static_cast<std::uint32_t>(ours.fans.row_count());
    const auto part = static_cast<std::uint32_t>(ours.parts.size());
    const auto node_block = static_cast<std::uint32_t>(ours.node_blocks.size());
    const auto fan_block = static_cast<std::uint32_t>(ours.fan_blocks.size());
    append_rows(ours.fans, theirs.fans, [&](std::uint32_t n) { return n + node; });
    for (const BodyBlock& b : theirs.node_blocks)
        ours.node_blocks.push_back({b.first + node, b.count, b.body + part});
    for (const BodyBlock& b : theirs.fan_blocks)
        ours.fan_blocks.push_back({b.first + fan, b.count, b.body + part});
    for (BodyPart p : theirs.parts) {
        p.first_node += node;
        p.first_block += node_block;
        p.first_fan_block += fan_block;
        p.centre = p.centre + shift;
        ours.parts.push_back(std::move(p));
    }
    // f = F + tau x (p - shift) for a position p in our coordinates
    for (const LoadedNode& l : theirs.loads)
        ours.loads.push_back({l.node + node, l.force - cross(l.torque, shift), l.torque});
    spring_count_ += other.spring_count_;
    measured_spring_count_ += other.measured_spring_count_;
}

}  // namespace pliant
