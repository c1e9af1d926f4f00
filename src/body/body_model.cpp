#include "body/body_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
namespace pliant {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

/// Spreads ten bits, with two zeros between neighbours.
std::uint32_t spread_bits(std::uint32_t a)
{
    a = (a | a << 16) & 0x030000ffu;
    a = (a | a << 8) & 0x0300f00fu;
    a = (a | a << 4) & 0x030c30c3u;
    return (a | a << 2) & 0x09249249u;
}

struct NodeTriangles {
    std::vector<std::uint32_t> start, corners;  ///< corners: 3 triangle + corner

    NodeTriangles(std::uint32_t node_count, std::span<const Triangle> triangles) : start(node_count + 1, 0)
    {
        for (const Triangle& t : triangles)
            for (const std::uint32_t node : t) ++start[node + 1];
        for (std::uint32_t i = 0; i < node_count; ++i) start[i + 1] += start[i];
        corners.resize(3 * triangles.size());
        std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
        for (std::uint32_t t = 0; t < triangles.size(); ++t)
            for (std::uint32_t k = 0; k < 3; ++k) corners[next[triangles[t][k]]++] = 3 * t + k;
    }
};

Vec3d mean_of(std::span<const Vec3> positions)
{
    Vec3d sum{};
    for (const Vec3& x : positions) sum = sum + to_double(x);
    return positions.empty() ? sum : sum * (1.0 / static_cast<double>(positions.size()));
}

/// Normalised sums of the area vectors around each vertex.
std::vector<Vec3d> vertex_normals(std::span<const Vec3> positions, std::span<const Triangle> triangles)
{
    std::vector<Vec3d> normals(positions.size());
    for (const Triangle& t : triangles) {
        const Vec3d a = to_double(positions[t[0]]);
        const Vec3d n = cross(to_double(positions[t[1]]) - a, to_double(positions[t[2]]) - a);
        for (const std::uint32_t node : t) normals[node] = normals[node] + n;
    }
    for (Vec3d& n : normals) {
        const double length = std::sqrt(dot(n, n));
        n = length > 0 ? n * (1 / length) : Vec3d{0, 1, 0};
    }
    return normals;
}

/// Distance at which a ray first leaves the surface, or infinity. Moeller and Trumbore, "Fast, minimum
/// storage ray/triangle intersection", 1997.
double exit_distance(Vec3d from, Vec3d direction, std::uint32_t start, std::span<const Vec3> positions,
                     std::span<const Triangle> triangles)
{
    double nearest = std::numeric_limits<double>::infinity();
    for (const Triangle& t : triangles) {
        if (t[0] == start || t[1] == start || t[2] == start) continue;
        const Vec3d a = to_double(positions[t[0]]);
        const Vec3d ab = to_double(positions[t[1]]) - a, ac = to_double(positions[t[2]]) - a;
        const Vec3d p = cross(direction, ac);
        const double determinant = dot(ab, p);
        if (determinant == 0) continue;
        const Vec3d s = from - a, q = cross(s, ab);
        const double u = dot(s, p) / determinant, v = dot(direction, q) / determinant;
        const double distance = dot(ac, q) / determinant;
        constexpr double edge = 1e-9;  // a ray through an edge must hit at least one of its triangles
        if (u < -edge || v < -edge || u + v > 1 + edge || distance <= 0) continue;
        nearest = std::min(nearest, distance);
    }
    return nearest;
}

}  // namespace

bool BodyModel::goals_move() const
{
    return std::any_of(parts.begin(), parts.end(), [](const BodyPart& part) {
        return part.options.target.size() > 1 || part.options.pressure.size() > 1;
    });
}

VolumeGoal BodyModel::goal_at(std::size_t part, double time) const
{
    const BodyPart& body = parts[part];
    return {6 * body.volume * value_at(body.options.target, time, 1),
            value_at(body.options.pressure, time, 0) / 6};
}

double value_at(const std::vector<TimedValue>& keyframes, double time, double otherwise)
{
    if (keyframes.empty()) return otherwise;
    const auto after = std::upper_bound(keyframes.begin(), keyframes.end(), time,
                                        [](double t, const TimedValue& frame) { return t < frame.time; });
    if (after == keyframes.begin()) return keyframes.front().value;
    if (after == keyframes.end()) return keyframes.back().value;
    const TimedValue& before = *(after - 1);
    const double part = (time - before.time) / (after->time - before.time);
    return before.value + part * (after->value - before.value);
}

std::vector<TimedValue> gradual_target(const std::vector<TimedValue>& target)
{
    if (target.empty() || value_at(target, 0, 1) == 1) return target;
    std::vector<TimedValue> gradual = {{0, 1}};
    for (std::size_t k = 0;; ++k) {  // the interval before target[k], and the one after the last
        const bool last = k == target.size();
        if (!last && !(target[k].time > 0)) continue;
        const auto [time, value] = gradual.back();
        const double ahead = value_at(target, time, 1) - value;
        const double slope =
            last ? 0 : (target[k].value - value_at(target, time, 1)) / (target[k].time - time);
        const double rate = std::copysign(fastest_start, ahead);
        const double meets = time + ahead / (rate - slope);
        if (meets > time && (last || meets <= target[k].time)) {
            gradual.push_back({meets, value_at(target, meets, 1)});
            for (; k < target.size(); ++k)
                if (target[k].time > meets) gradual.push_back(target[k]);
            return gradual;
        }
        gradual.push_back({target[k].time, value + rate * (target[k].time - time)});
    }
}

double sixfold_volume(std::span<const Vec3> positions, std::span<const Triangle> triangles)
{
    if (positions.empty()) return 0;
    const Vec3d origin = mean_of(positions);
    double sum = 0;
    for (const Triangle& t : triangles)
        sum += dot(to_double(positions[t[0]]) - origin,
                   cross(to_double(positions[t[1]]) - origin, to_double(positions[t[2]]) - origin));
    return sum;
}

std::vector<std::uint32_t> node_order(const SurfaceMesh& mesh)
{
    const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
    Vec3 least{1e30f, 1e30f, 1e30f}, most{-1e30f, -1e30f, -1e30f};
    for (const Vec3& v : mesh.vertices) {
        least = {std::min(least.x, v.x), std::min(least.y, v.y), std::min(least.z, v.z)};
        most = {std::max(most.x, v.x), std::max(most.y, v.y), std::max(most.z, v.z)};
    }
    const float extent = std::max({most.x - least.x, most.y - least.y, most.z - least.z, 1e-30f});
    const auto cell = [&](float a, float from) {
        return spread_bits(static_cast<std::uint32_t>(1023 * std::min(1.0f, (a - from) / extent)));
    };
    std::vector<std::pair<std::uint32_t, std::uint32_t>> places;  // along Morton's curve
    places.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3& v = mesh.vertices[i];
        places.emplace_back(cell(v.x, least.x) | cell(v.y, least.y) << 1 | cell(v.z, least.z) << 2, i);
    }
    std::sort(places.begin(), places.end());

    std::vector<std::uint32_t> valence(count, 0), order;
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t node : t) ++valence[node];
    order.reserve(count);
    for (const auto& [code, vertex] : places) order.push_back(vertex);
    // Nodes of a block are close together anyway; rings of equal length fill the lanes of a pack.
    constexpr std::uint32_t block = BodyBlock::most;
    for (std::uint32_t first = 0; first < count; first += block)
        std::stable_sort(order.begin() + first, order.begin() + std::min(first + block, count),
                         [&](std::uint32_t a, std::uint32_t b) { return valence[a] > valence[b]; });
    return order;
}

Ragged<std::uint32_t> rings_of(std::uint32_t node_count, std::span<const Triangle> triangles)
{
    const NodeTriangles around(node_count, triangles);
    Ragged<std::uint32_t> rings;
    rings.start.push_back(0);
    rings.entries.reserve(around.corners.size());
    std::vector<std::pair<std::uint32_t, std::uint32_t>>
        sides;  // of one node: (b, c) of each triangle (node, b, c)
    for (std::uint32_t node = 0; node < node_count; ++node) {
        sides.clear();
        for (std::uint32_t k = around.start[node]; k < around.start[node + 1]; ++k) {
            const Triangle& t = triangles[around.corners[k] / 3];
            const std::uint32_t corner = around.corners[k] % 3;
            sides.emplace_back(t[(corner + 1) % 3], t[(corner + 2) % 3]);
        }
        std::sort(sides.begin(), sides.end());
        std::uint32_t at = sides.front().first;
        for (std::size_t k = 0; k < sides.size(); ++k) {
            rings.entries.push_back(at);
            at = std::lower_bound(sides.begin(), sides.end(), std::make_pair(at, 0u))->second;
        }
        rings.start.push_back(static_cast<std::uint32_t>(rings.entries.size()));
    }
    return rings;
}

Ragged<std::uint32_t> fans_of(const Ragged<std::uint32_t>& rings)
{
    const auto count = static_cast<std::uint32_t>(rings.row_count());
    // Entry k of the ring of a stands for the triangle (a, b_k, b_k+1), which also occurs in the rings of b_k
    // and b_k+1.
    std::vector<bool> taken(rings.entries.size(), false);
    const auto next_in = [&](std::uint32_t node, std::uint32_t k) {
        return k + 1 < rings.start[node + 1] ? k + 1 : rings.start[node];
    };
    const auto take = [&](std::uint32_t node, std::uint32_t b, std::uint32_t c) {
        for (std::uint32_t k = rings.start[node]; k < rings.start[node + 1]; ++k)
            if (rings.entries[k] == b && rings.entries[next_in(node, k)] == c) {
                taken[k] = true;
                return;
            }
    };

    std::vector<std::uint32_t> left(count);
    const auto count_left = [&](std::uint32_t node) {
        return static_cast<std::uint32_t>(
            std::count(taken.begin() + rings.start[node], taken.begin() + rings.start[node + 1], false));
    };
    for (std::uint32_t node = 0; node < count; ++node) left[node] = count_left(node);
    const auto most_left = [&] { return left.empty() ? 0u : *std::max_element(left.begin(), left.end()); };

    // Greedy: take a node with the most remaining triangles; each run of them is a fan.
    std::vector<std::vector<std::uint32_t>> fans;
    // `left` is an upper bound, so its maximum is the next count to search for. Below a node of thousands of
    // triangles there may be none of hundreds.
    for (std::uint32_t wanted = most_left(); wanted > 0; wanted = most_left())
        for (std::uint32_t node = 0; node < count; ++node) {
            if (left[node] < wanted) continue;
            left[node] = count_left(node);
            if (left[node] < wanted) continue;
            const std::uint32_t begin = rings.start[node], end = rings.start[node + 1], length = end - begin;
            std::uint32_t first = 0;  // a run starts after a triangle that is taken
            while (first < length && !taken[begin + first]) ++first;
            if (first == length) first = length - 1;
            std::vector<std::uint32_t> fan;
            for (std::uint32_t step = 1; step <= length; ++step) {
                const std::uint32_t k = begin + (first + step) % length;
                if (taken[k]) {
                    if (!fan.empty()) fans.push_back(std::move(fan));
                    fan.clear();
                    continue;
                }
                const std::uint32_t b = rings.entries[k], c = rings.entries[next_in(node, k)];
                if (fan.empty()) fan = {node, b};
                fan.push_back(c);
                taken[k] = true;
                take(b, c, node);
                take(c, node, b);
            }
            if (!fan.empty()) fans.push_back(std::move(fan));
            left[node] = 0;
        }
    // Sorted as the nodes are: by apex, and within a block by length, so that packs are full.
    std::stable_sort(fans.begin(), fans.end(), [](const auto& a, const auto& b) { return a[0] < b[0]; });
    constexpr auto block = static_cast<std::ptrdiff_t>(BodyBlock::most);
    for (auto first = fans.begin(); first != fans.end();) {
        const auto last = first + std::min(block, fans.end() - first);
        std::stable_sort(first, last, [](const auto& a, const auto& b) { return a.size() > b.size(); });
        first = last;
    }
    Ragged<std::uint32_t> result;
    result.start.push_back(0);
    for (const auto& fan : fans) {
        result.entries.insert(result.entries.end(), fan.begin(), fan.end());
        result.start.push_back(static_cast<std::uint32_t>(result.entries.size()));
    }
    return result;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> internal_pairs(std::span<const Vec3> positions,
                                                                    std::span<const Triangle> triangles,
                                                                    const InternalSprings& options)
{
    using Pair = std::pair<std::uint32_t, std::uint32_t>;
    if (options.kind == InternalKind::none) return {};
    const auto count = static_cast<std::uint32_t>(positions.size());
    const std::vector<Vec3d> normals = vertex_normals(positions, triangles);
    const auto nearest_to = [&](Vec3d point, std::uint32_t except) {
        std::uint32_t nearest = nobody;
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t j = 0; j < count; ++j) {
            const Vec3d d = to_double(positions[j]) - point;
            if (j != except && dot(d, d) < least) least = dot(d, d), nearest = j;
        }
        return nearest;
    };

    std::vector<std::vector<std::uint32_t>> choices(count);  // of each node, the best first
    std::vector<std::pair<double, std::uint32_t>> facing;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3d x = to_double(positions[i]), inward = normals[i] * -1.0;
        if (options.kind == InternalKind::opposite) {
            const double distance = exit_distance(x, inward, i, positions, triangles);
            if (std::isfinite(distance)) choices[i].push_back(nearest_to(x + inward * distance, i));
            continue;
        }
        // Candidates: nodes that a straight line through the inside reaches, within 60 degrees of the inward
        // normal at both ends.
        constexpr double straight = 0.5;
        facing.clear();
        for (std::uint32_t j = 0; j < count; ++j) {
            const Vec3d d = to_double(positions[j]) - x;
            const double length2 = dot(d, d), along = dot(d, inward), arriving = dot(d, normals[j]);
            if (along > 0 && arriving > 0 && along * along > straight * straight * length2 &&
                arriving * arriving > straight * straight * length2)
                facing.emplace_back(length2, j);
        }
        const auto wanted = std::min<std::size_t>(options.neighbours, facing.size());
        std::partial_sort(facing.begin(), facing.begin() + static_cast<std::ptrdiff_t>(wanted), facing.end());
        for (std::size_t k = 0; k < wanted; ++k) choices[i].push_back(facing[k].second);
    }

    std::set<Pair> chosen;
    const std::size_t most = options.most > 0 ? options.most : std::numeric_limits<std::size_t>::max();
    for (std::size_t rank = 0; rank < options.neighbours || rank == 0; ++rank) {
        for (std::uint32_t i = 0; i < count && chosen.size() < most; ++i) {
            if (rank >= choices[i].size()) continue;
            const std::uint32_t j = choices[i][rank];
            chosen.insert(i < j ? Pair{i, j} : Pair{j, i});
        }
        if (chosen.size() >= most) break;
    }
    return {chosen.begin(), chosen.end()};
}

}  // namespace pliant
