#include "body/mesh_hierarchy.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <compare>
#include <utility>

#include "body/node_layout.hpp"
#include "kernels/planes.hpp"

namespace pliant {
namespace {

/// A coupling counts as strong in aggregation and smoothing if it is at least this part of the strongest one
/// at either of its ends.
constexpr double strong_part = 0.1;

constexpr std::uint32_t nowhere = ~0u;

/// Groups entries into rows by the row that each names; keeps the order within a row.
template <class Entry, class RowOf, class EntryOf, class Source>
Ragged<Entry> rows_of(std::size_t row_count, const std::vector<Source>& sources, RowOf&& row_of,
                      EntryOf&& entry_of)
{
    Ragged<Entry> rows;
    rows.start.assign(row_count + 1, 0);
    for (const Source& a : sources) ++rows.start[row_of(a) + 1];
    for (std::size_t k = 0; k < row_count; ++k) rows.start[k + 1] += rows.start[k];
    rows.entries.resize(sources.size());
    std::vector<std::uint32_t> next(rows.start.begin(), rows.start.end() - 1);
    for (const Source& a : sources) rows.entries[next[row_of(a)]++] = entry_of(a);
    return rows;
}

struct StrongNeighbour {
    std::uint32_t node = 0;
    double weight = 0;
};

Ragged<StrongNeighbour> strong_neighbours(const MeshGraph& graph)
{
    std::vector<double> strongest(graph.node_count, 0.0);
    for (const auto& c : graph.couplings)
        for (const std::uint32_t node : {c.i, c.j}) strongest[node] = std::max(strongest[node], c.weight);
    struct Side {
        std::uint32_t node, other;
        double weight;
    };
    std::vector<Side> sides;
    for (const auto& c : graph.couplings) {
        if (!(c.weight > 0) || c.weight < strong_part * std::min(strongest[c.i], strongest[c.j])) continue;
        sides.push_back({c.i, c.j, c.weight});
        sides.push_back({c.j, c.i, c.weight});
    }
    return rows_of<StrongNeighbour>(
        graph.node_count, sides, [](const Side& s) { return s.node; },
        [](const Side& s) {
            return StrongNeighbour{s.other, s.weight};
        });
}

/// The aggregate of each node, numbered in the order of their first members; `nowhere` for isolated nodes.
struct Aggregates {
    std::uint32_t count = 0;
    std::vector<std::uint32_t> of;
};

Aggregates aggregated(const Ragged<StrongNeighbour>& neighbours)
{
    const std::size_t node_count = neighbours.start.size() - 1;
    Aggregates a;
    a.of.assign(node_count, nowhere);
    for (std::uint32_t i = 0; i < node_count; ++i) {
        const auto row = neighbours.row(i);
        const auto is_taken = [&](const StrongNeighbour& n) { return a.of[n.node] != nowhere; };
        if (a.of[i] != nowhere || row.empty() || std::any_of(row.begin(), row.end(), is_taken)) continue;
        a.of[i] = a.count;
        for (const StrongNeighbour& n : row) a.of[n.node] = a.count;
        ++a.count;
    }
    // The remaining nodes have a neighbour in an aggregate, or they would have become roots.
    const std::vector<std::uint32_t> roots = a.of;
    for (std::uint32_t i = 0; i < node_count; ++i) {
        if (roots[i] != nowhere) continue;
        double strongest = 0;
        for (const StrongNeighbour& n : neighbours.row(i))
            if (roots[n.node] != nowhere && n.weight > strongest) {
                strongest = n.weight;
                a.of[i] = roots[n.node];
            }
    }
    return a;
}

/// The largest eigenvalue of D^-1 L, estimated from below, at most 2; L is the Laplacian of the strong
/// couplings, D its diagonal.
double largest_eigenvalue(const Ragged<StrongNeighbour>& neighbours)
{
    const std::size_t count = neighbours.start.size() - 1;
    std::vector<double> x(count), y(count);
    std::uint32_t state = 1;
    for (double& a : x) {
        state = state * 1664525u + 1013904223u;
        a = state / 4294967296.0 - 0.5;
    }
    double eigenvalue = 0;
    constexpr int steps = 20;
    for (int step = 0; step < steps; ++step) {
        double before = 0, after = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            double sum = 0, diagonal = 0;
            for (const StrongNeighbour& n : neighbours.row(i)) {
                sum += n.weight * (x[i] - x[n.node]);
                diagonal += n.weight;
            }
            y[i] = diagonal > 0 ? sum / diagonal : 0;
            before += diagonal * x[i] * x[i];
            after += diagonal * y[i] * y[i];
        }
        if (!(after > 0)) break;
        eigenvalue = std::sqrt(after / before);
        const double scale = 1 / std::sqrt(after);
        for (std::uint32_t i = 0; i < count; ++i) x[i] = y[i] * scale;
    }
    return eigenvalue;
}

/// P = (I - w D^-1 L) P0, where P0 is 1 for a node in its aggregate. Rows sum to 1, since those of L sum to
/// 0.
Ragged<WeightedSource> parents_of(const Ragged<StrongNeighbour>& neighbours, const Aggregates& aggregates)
{
    const double eigenvalue = largest_eigenvalue(neighbours);
    const double w = eigenvalue > 0 ? 4 / (3 * eigenvalue) : 0;
    Ragged<WeightedSource> parents;
    parents.start.push_back(0);
    std::vector<std::pair<std::uint32_t, double>> row;
    for (std::uint32_t i = 0; i < aggregates.of.size(); ++i) {
        row.clear();
        const std::uint32_t own = aggregates.of[i];
        double total = 0;
        for (const StrongNeighbour& n : neighbours.row(i)) total += n.weight;
        for (const StrongNeighbour& n : neighbours.row(i)) {
            const std::uint32_t other = aggregates.of[n.node];
            if (other == own) continue;
            const auto known =
                std::find_if(row.begin(), row.end(), [&](const auto& e) { return e.first == other; });
            if (known == row.end())
                row.emplace_back(other, w * n.weight / total);
            else
                known->second += w * n.weight / total;
        }
        if (own != nowhere) {
            double rest = 1;
            for (const auto& entry : row) rest -= static_cast<float>(entry.second);
            row.emplace_back(own, rest);
            std::sort(row.begin(), row.end());
            for (const auto& [coarse, weight] : row)
                parents.entries.push_back({coarse, static_cast<float>(weight)});
        }
        parents.start.push_back(static_cast<std::uint32_t>(parents.entries.size()));
    }
    return parents;
}

/// A term of the coarse operator: the part of a fine block in the coupling of coarse nodes i < j.
struct Share {
    std::uint32_t i = 0, j = 0, source = 0;
    double weight = 0;
};

/// Galerkin: P applied to the energy of the fine level, written with differences as that energy is:
///   B(I, J) = -sum_e (P_iI - P_jI) (P_iJ - P_jJ) B_e - sum_i P_iI P_iJ s_i,   s(I) = sum_i P_iI s_i
/// and the diagonal is D(I) = s(I) + sum_J B(I, J).
std::vector<Share> shares_of(const MeshGraph& fine, const Ragged<WeightedSource>& parents)
{
    std::vector<Share> shares;
    const auto couplings = static_cast<std::uint32_t>(fine.couplings.size());
    std::vector<std::pair<std::uint32_t, double>> change;
    const auto add = [&](std::uint32_t source) {
        for (std::size_t a = 0; a < change.size(); ++a)
            for (std::size_t b = a + 1; b < change.size(); ++b)
                shares.push_back(
                    {change[a].first, change[b].first, source, -change[a].second * change[b].second});
    };
    for (std::uint32_t e = 0; e < couplings; ++e) {
        const auto of_i = parents.row(fine.couplings[e].i), of_j = parents.row(fine.couplings[e].j);
        change.clear();
        for (std::size_t a = 0, b = 0; a < of_i.size() || b < of_j.size();) {
            const std::uint32_t i = a < of_i.size() ? of_i[a].source : nowhere;
            const std::uint32_t j = b < of_j.size() ? of_j[b].source : nowhere;
            double difference = 0;
            if (i <= j) difference += of_i[a++].weight;
            if (j <= i) difference -= of_j[b++].weight;
            if (difference != 0) change.emplace_back(std::min(i, j), difference);
        }
        add(e);
    }
    for (std::uint32_t i = 0; i < fine.node_count; ++i) {
        change.clear();
        for (const WeightedSource& p : parents.row(i)) change.emplace_back(p.source, p.weight);
        add(couplings + i);
    }
    return shares;
}

}  // namespace

CoarseMesh coarser(const MeshGraph& fine)
{
    CoarseMesh coarse;
    const Ragged<StrongNeighbour> neighbours = strong_neighbours(fine);
    const Aggregates aggregates = aggregated(neighbours);
    MeshGraph& graph = coarse.graph;
    graph.node_count = aggregates.count;
    coarse.parents = parents_of(neighbours, aggregates);

    std::vector<Share> all;
    for (std::uint32_t i = 0; i < fine.node_count; ++i)
        for (const WeightedSource& p : coarse.parents.row(i))
            all.push_back({p.source, p.source, i, p.weight});
    const auto row_of = [](const Share& s) { return s.i; };
    const auto entry_of = [](const Share& s) {
        return WeightedSource{s.source, static_cast<float>(s.weight)};
    };
    coarse.children = rows_of<WeightedSource>(aggregates.count, all, row_of, entry_of);

    std::vector<Share> pairs = shares_of(fine, coarse.parents);
    std::stable_sort(pairs.begin(), pairs.end(), by_ends);
    coarse.couplings.start.push_back(0);
    for (std::size_t k = 0; k < pairs.size();) {
        MeshGraph::Coupling coupling{pairs[k].i, pairs[k].j, 0};
        for (; k < pairs.size() && pairs[k].i == coupling.i && pairs[k].j == coupling.j; ++k) {
            if (pairs[k].source < fine.couplings.size())
                coupling.weight += pairs[k].weight * fine.couplings[pairs[k].source].weight;
            coarse.couplings.entries.push_back(entry_of(pairs[k]));
        }
        graph.couplings.push_back(coupling);
        coarse.couplings.start.push_back(static_cast<std::uint32_t>(coarse.couplings.entries.size()));
    }
    return coarse;
}

namespace {

bool is_free(const ClothModel& cloth, std::uint32_t node) { return cloth.masses.inverse(node) > 0; }

/// Index in cloth.springs of the spring between two nodes, if its class is not off and one of them is free;
/// else `nowhere`.
std::uint32_t spring_between(const ClothModel& cloth, std::uint32_t a, std::uint32_t b)
{
    const std::uint32_t i = std::min(a, b), j = std::max(a, b);
    const auto found = std::lower_bound(
        cloth.springs.list.begin(), cloth.springs.list.end(), std::pair(i, j),
        [](const Spring& s, std::pair<std::uint32_t, std::uint32_t> p) { return std::pair(s.i, s.j) < p; });
    if (found == cloth.springs.list.end() || found->i != i || found->j != j) return nowhere;
    const bool exists = cloth.limits.of_class[static_cast<std::size_t>(found->spring_class)].exists;
    if (!exists || (!is_free(cloth, i) && !is_free(cloth, j))) return nowhere;
    return static_cast<std::uint32_t>(found - cloth.springs.list.begin());
}

/// A bend spring (a, d) about the side (b, c), and the springs from a to b or c, and from there to d.
struct Fold {
    std::uint32_t spring = 0, halves[2]{};
};

/// Bend springs that the operator folds onto sides of their two triangles, as on a sheet onto the two halves:
/// |x_a - x_d|^2 <= 2 (|x_a - x_b|^2 + |x_b - x_d|^2), so it is no softer than E. They go through b or c in
/// turn, chosen by the numbers of the four nodes. Folding halves the couplings of a mesh. Nothing is folded
/// where bend springs are limits or graded.
std::vector<Fold> folds_of(const ClothModel& cloth)
{
    std::vector<Fold> folds;
    if (cloth.plan.graded || cloth.limits.bends_by_constraints() || cloth.plan.corrects_steps()) return folds;
    struct Side {
        std::uint32_t b, c, opposite;
        auto operator<=>(const Side&) const = default;
    };
    std::vector<Side> sides;
    for (const Triangle& t : cloth.shape.triangles())
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t b = t[k], c = t[(k + 1) % 3];
            sides.push_back({std::min(b, c), std::max(b, c), t[(k + 2) % 3]});
        }
    std::sort(sides.begin(), sides.end());
    for (std::size_t k = 1; k < sides.size(); ++k) {
        const Side &one = sides[k - 1], &other = sides[k];
        if (one.b != other.b || one.c != other.c || one.opposite == other.opposite) continue;
        const std::uint32_t a = one.opposite, d = other.opposite;
        const std::uint32_t between = (a + d + one.b + one.c) % 2 == 0 ? one.b : one.c;
        const Fold fold{spring_between(cloth, a, d),
                        {spring_between(cloth, a, between), spring_between(cloth, between, d)}};
        if (fold.spring == nowhere || fold.halves[0] == nowhere || fold.halves[1] == nowhere) continue;
        if (!is_free(cloth, a) || !is_free(cloth, d)) continue;
        if (cloth.springs.list[fold.spring].spring_class != SpringClass::bend) continue;
        folds.push_back(fold);
    }
    // A pair opposite to several sides is one spring.
    std::stable_sort(folds.begin(), folds.end(),
                     [](const Fold& a, const Fold& b) { return a.spring < b.spring; });
    folds.erase(std::unique(folds.begin(), folds.end(),
                            [](const Fold& a, const Fold& b) { return a.spring == b.spring; }),
                folds.end());
    return folds;
}

/// The solver's order of a mesh's springs: first those between free nodes, then those to a pinned node, then
/// loose ones. Springs of a class that is off, or between pinned nodes, are omitted.
struct SolverSprings {
    std::vector<Spring> springs;
    std::size_t coupling_count = 0, loose_first = 0;
    Ragged<WeightedSource> folds;  ///< by spring before loose_first: itself and the springs folded onto it
};

SolverSprings solver_springs(const ClothModel& cloth)
{
    SolverSprings list;
    const std::vector<Fold> folds = folds_of(cloth);
    std::vector<bool> is_loose(cloth.springs.list.size(), false);
    for (const Fold& fold : folds) is_loose[fold.spring] = true;
    std::vector<std::uint32_t> number(cloth.springs.list.size(), nowhere);
    const auto add_where = [&](auto&& condition) {
        for (std::size_t k = 0; k < cloth.springs.list.size(); ++k) {
            const Spring& s = cloth.springs.list[k];
            if (!cloth.limits.of_class[static_cast<std::size_t>(s.spring_class)].exists) continue;
            const int free_ends = int{is_free(cloth, s.i)} + int{is_free(cloth, s.j)};
            if (!condition(free_ends, is_loose[k])) continue;
            number[k] = static_cast<std::uint32_t>(list.springs.size());
            list.springs.push_back(s);
        }
    };
    add_where([](int free_ends, bool loose) { return free_ends == 2 && !loose; });
    list.coupling_count = list.springs.size();
    add_where([](int free_ends, bool) { return free_ends == 1; });
    list.loose_first = list.springs.size();
    add_where([](int, bool loose) { return loose; });
    if (folds.empty()) return list;
    struct Source {
        std::uint32_t edge, source;
    };
    std::vector<Source> sources;
    for (std::uint32_t e = 0; e < list.loose_first; ++e) sources.push_back({e, e});
    for (const Fold& fold : folds)
        for (const std::uint32_t half : fold.halves) sources.push_back({number[half], number[fold.spring]});
    list.folds = rows_of<WeightedSource>(
        list.loose_first, sources, [](const Source& s) { return s.edge; },
        [](const Source& s) {
            return WeightedSource{s.source, s.source == s.edge ? 1.0f : 2.0f};
        });
    return list;
}

/// Appends tables of integers for kernels.
class TopologyWriter {
public:
    explicit TopologyWriter(std::vector<std::int32_t>& topology) : topology_(topology) {}

    std::int32_t position() const { return static_cast<std::int32_t>(topology_.size()); }
    void add(std::int32_t a) { topology_.push_back(a); }

    /// Writes the starts of rows, as offsets in `topology`, and then the rows, of pairs. Returns the offset
    /// of the starts.
    template <class Entry, class WriteEntry>
    std::int32_t add_rows(const Ragged<Entry>& rows, WriteEntry&& write_entry)
    {
        const std::int32_t where = position();
        const std::int32_t first = where + static_cast<std::int32_t>(rows.start.size());
        for (const std::uint32_t start : rows.start) add(first + 2 * static_cast<std::int32_t>(start));
        for (const Entry& entry : rows.entries) write_entry(entry);
        return where;
    }
    std::int32_t add_weighted(const Ragged<WeightedSource>& rows, std::int32_t offset)
    {
        return add_rows(rows, [&](const WeightedSource& a) {
            add(offset + static_cast<std::int32_t>(a.source));
            add(std::bit_cast<std::int32_t>(a.weight));
        });
    }

private:
    std::vector<std::int32_t>& topology_;
};

}  // namespace

SolverLevel& Hierarchy::append_mesh_level(std::int32_t nodes, std::int32_t edges,
                                          std::int32_t node_planes_count, std::int32_t edge_planes_count)
{
    const auto whole = [](std::int32_t a) {
        constexpr auto pad = static_cast<std::int32_t>(NodeLayout::pad);
        return (a + pad - 1) / pad * pad;
    };
    SolverLevel level;
    level.rows = 1;
    level.columns = std::max(nodes, 1);
    level.stride = static_cast<std::int32_t>(NodeLayout(1, static_cast<std::size_t>(level.columns)).stride);
    // Offsets follow NodeLayout, but a single row needs no border: planes overlap there.
    const std::int32_t border = static_cast<std::int32_t>(NodeLayout::border_rows) * level.stride;
    level.size = level.stride + static_cast<std::int32_t>(NodeLayout::pad);
    number_count = std::max(number_count, static_cast<std::size_t>(border));
    level.base = static_cast<std::int32_t>(number_count) - border;
    number_count += static_cast<std::size_t>(node_planes_count) * static_cast<std::size_t>(level.size);
    level.edges = edges;
    level.edge_base = static_cast<std::int32_t>(number_count);
    // One extra block that couples nothing, for lanes of packs without a block of their own.
    level.edge_size = whole(edges + level.columns + 1);
    number_count += static_cast<std::size_t>(edge_planes_count) * static_cast<std::size_t>(level.edge_size);
    levels.push_back(level);
    return levels.back();
}

/// Aggregates until few nodes are left. Every level at least halves the coupled nodes, so this ends.
void Hierarchy::build_mesh(const ClothModel& cloth)
{
    constexpr std::uint32_t few = 12;
    TopologyWriter writer(topology);

    struct Side {
        std::uint32_t node, other, edge;
    };
    /// Rows of (neighbour, edge) by node.
    const auto add_sides = [&](const SolverLevel& level, const std::vector<Side>& sides) {
        const auto rows = rows_of<Side>(
            static_cast<std::size_t>(level.columns), sides, [](const Side& s) { return s.node; },
            [](const Side& s) { return s; });
        return writer.add_rows(rows, [&](const Side& s) {
            writer.add(offset(level, 0, static_cast<std::int32_t>(s.other)));
            writer.add(static_cast<std::int32_t>(s.edge));
        });
    };
    const auto add_ends = [&](const SolverLevel& level, std::uint32_t i, std::uint32_t j) {
        for (const std::uint32_t node : {i, j}) writer.add(offset(level, 0, static_cast<std::int32_t>(node)));
    };

    const SolverSprings list = solver_springs(cloth);
    MeshGraph graph;
    graph.node_count = cloth.node_count();
    std::int32_t planes = node_planes;
    if (cloth.plan.is_second_order()) history_plane = std::exchange(planes, planes + history_planes);
    SolverLevel* level =
        &append_mesh_level(static_cast<std::int32_t>(cloth.node_count()),
                           static_cast<std::int32_t>(list.springs.size()), planes, edge_planes);
    std::vector<Side> sides, held, loose;
    level->edge_ends = writer.position();
    for (std::uint32_t e = 0; e < list.springs.size(); ++e) {
        const Spring& s = list.springs[e];
        add_ends(*level, s.i, s.j);
        writer.add(static_cast<std::int32_t>(s.spring_class));
        if (e < list.coupling_count) {
            const LimitedSprings& limited = cloth.limits.of_class[static_cast<std::size_t>(s.spring_class)];
            graph.couplings.push_back({s.i, s.j, std::max({limited.below, limited.beyond, 1e-9})});
            sides.push_back({s.i, s.j, e});
            sides.push_back({s.j, s.i, e});
        } else if (e >= list.loose_first) {
            loose.push_back({s.i, s.j, e});
            loose.push_back({s.j, s.i, e});
        } else {
            held.push_back(is_free(cloth, s.i) ? Side{s.i, s.j, e} : Side{s.j, s.i, e});
        }
    }
    level->row_start = add_sides(*level, sides);
    level->held_start = add_sides(*level, held);
    level->loose_start = add_sides(*level, loose);
    level->held = static_cast<std::int32_t>(list.coupling_count);
    level->loose = static_cast<std::int32_t>(list.loose_first);
    if (level->folds()) level->fold_start = writer.add_weighted(list.folds, 0);
    rest_lengths.reserve(list.springs.size());
    for (const Spring& s : list.springs) rest_lengths.push_back(static_cast<float>(s.rest_length));
    if (cloth.plan.graded)
        for (const Spring& s : list.springs) scales.push_back(s.scale), bending.push_back(s.bending);

    do {
        const CoarseMesh coarse = coarser(graph);
        const SolverLevel finer = levels.back();
        level = &append_mesh_level(static_cast<std::int32_t>(coarse.graph.node_count),
                                   static_cast<std::int32_t>(coarse.graph.couplings.size()), level_planes,
                                   edge_force);
        // The blocks of springs to pins and of loose springs lie between the couplings and the row sums of
        // the cloth's level.
        const auto couplings = static_cast<std::uint32_t>(graph.couplings.size());
        const auto add_blocks = [&](const Ragged<WeightedSource>& rows) {
            return writer.add_rows(rows, [&](const WeightedSource& a) {
                const bool is_node = a.source >= couplings;
                writer.add(static_cast<std::int32_t>(is_node ? a.source - couplings : a.source) +
                           (is_node ? finer.edges : 0));
                writer.add(std::bit_cast<std::int32_t>(a.weight));
            });
        };
        level->parents_start = writer.add_weighted(coarse.parents, offset(*level, 0, 0));
        level->children_start = writer.add_weighted(coarse.children, offset(finer, 0, 0));
        level->coupling_start = add_blocks(coarse.couplings);
        sides.clear();
        level->edge_ends = writer.position();
        for (std::uint32_t e = 0; e < coarse.graph.couplings.size(); ++e) {
            const auto& c = coarse.graph.couplings[e];
            add_ends(*level, c.i, c.j);
            writer.add(0);
            sides.push_back({c.i, c.j, e});
            sides.push_back({c.j, c.i, e});
        }
        level->row_start = add_sides(*level, sides);
        graph = coarse.graph;
    } while (graph.node_count > few);
}

}  // namespace pliant
