#include "body/bending.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pliant {
namespace {

/// The part of a row's or column's area that belongs to it: half at a border.
double part_of(std::uint32_t k, std::uint32_t count) { return k == 0 || k + 1 == count ? 0.5 : 1; }

struct GridSpring {
    std::uint32_t row, column;  ///< of its first node
    bool along_row, along_column;

    GridSpring(const Spring& spring, const SheetShape& sheet)
        : row(spring.i / sheet.columns),
          column(spring.i % sheet.columns),
          along_row(spring.j / sheet.columns == row),
          along_column(spring.j % sheet.columns == column)
    {
    }
};

/// A side of a triangle, and the vertex opposite to it.
struct TriangleSide {
    std::uint32_t i, j, triangle, opposite;
};

struct PairWeight {
    std::uint32_t i, j;
    double weight;  ///< N/m
};

std::vector<TriangleSide> sides_of(std::span<const Triangle> triangles)
{
    std::vector<TriangleSide> sides;
    sides.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), t, triangles[t][(k + 2) % 3]});
        }
    std::sort(sides.begin(), sides.end(), [](const TriangleSide& a, const TriangleSide& b) {
        return a.i != b.i ? a.i < b.i : a.j != b.j ? a.j < b.j : a.triangle < b.triangle;
    });
    return sides;
}

struct Point2 {
    double x, y;
};
Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
double cotangent(Point2 a, Point2 b) { return (a.x * b.x + a.y * b.y) / std::abs(a.x * b.y - a.y * b.x); }

/// A triangle and its neighbours, unfolded into its plane: gives its curvature from the bends of its sides.
class BentTriangle {
public:
    BentTriangle(const Triangle& triangle, std::uint32_t index, const std::vector<TriangleSide>& sides,
                 const std::vector<Vec3>& positions)
    {
        const auto at = [&](std::uint32_t node) { return to_double(positions[node]); };
        // The corners, side 0 along x.
        const Vec3d d = at(triangle[1]) - at(triangle[0]), e = at(triangle[2]) - at(triangle[0]);
        const double length = std::sqrt(dot(d, d)), along = dot(e, d) / length;
        const double height = std::sqrt(std::max(0.0, dot(e, e) - along * along));
        const Point2 corners[] = {{0, 0}, {length, 0}, {along, height}};
        area_ = 0.5 * length * height;
        for (std::size_t k = 0; k < 3; ++k) nodes_.push_back({triangle[k], corners[k]});
        if (!(area_ > 0) || !std::isfinite(area_)) return;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t i = triangle[k], j = triangle[(k + 1) % 3];
            const auto other = std::find_if(
                std::lower_bound(sides.begin(), sides.end(), std::minmax(i, j),
                                 [](const TriangleSide& s, auto pair) {
                                     return s.i != pair.first ? s.i < pair.first : s.j < pair.second;
                                 }),
                sides.end(), [&](const TriangleSide& s) {
                    return s.i != std::min(i, j) || s.j != std::max(i, j) || s.triangle != index;
                });
            const bool exists =
                other != sides.end() && other->i == std::min(i, j) && other->j == std::max(i, j);
            if (!exists || other->opposite == triangle[(k + 2) % 3]) continue;
            const Point2 p = corners[k], q = corners[(k + 1) % 3], edge = q - p;
            const Vec3d side = at(j) - at(i), wing = at(other->opposite) - at(i);
            const double l = std::sqrt(dot(side, side)), t = dot(wing, side) / l;
            const double h = std::sqrt(std::max(0.0, dot(wing, wing) - t * t));
            // With counter-clockwise corners, outside is to the right of a side.
            const Point2 far{p.x + (t * edge.x + h * edge.y) / l, p.y + (t * edge.y - h * edge.x) / l};
            if (h > 1e-6 * l) add_side(k, (k + 1) % 3, (k + 2) % 3, other->opposite, far);
        }
    }

    /// E = B/2 A |S|^2 for the smallest curvature S that gives the sides their bends. With three bends S is
    /// unique; at a border, with one or two, it is the one without a moment at the free sides.
    void add(double bending_stiffness, std::vector<PairWeight>& weights) const
    {
        const std::size_t count = bends_.size();
        if (count == 0) return;
        // G = M W^-1 M^T with |S|^2 = S11^2 + 2 S12^2 + S22^2, and its inverse by elimination.
        double g[3][6] = {};
        for (std::size_t a = 0; a < count; ++a) {
            for (std::size_t b = 0; b < count; ++b)
                g[a][b] = bends_[a].m[0] * bends_[b].m[0] + bends_[a].m[1] * bends_[b].m[1] / 2 +
                          bends_[a].m[2] * bends_[b].m[2];
            g[a][count + a] = 1;
        }
        for (std::size_t a = 0; a < count; ++a) {
            const double pivot = g[a][a];
            for (double& number : g[a]) number /= pivot;
            for (std::size_t b = 0; b < count; ++b) {
                const double factor = g[b][a];
                for (std::size_t c = 0; b != a && c < 6; ++c) g[b][c] -= factor * g[a][c];
            }
        }
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            for (std::size_t j = i + 1; j < nodes_.size(); ++j) {
                double q = 0;
                for (std::size_t a = 0; a < count; ++a)
                    for (std::size_t b = 0; b < count; ++b)
                        q += bends_[a].c[i] * g[a][count + b] * bends_[b].c[j];
                const double weight = -bending_stiffness * area_ * q;
                const std::uint32_t one = nodes_[i].node, two = nodes_[j].node;
                if (weight != 0 && std::isfinite(weight) && one != two)
                    weights.push_back({std::min(one, two), std::max(one, two), weight});
            }
    }

private:
    /// The bend of a side, sum c_a x_a over the nodes; for x = 1/2 r . S r it is m . (S11, S12, S22).
    struct Bend {
        std::array<double, 6> c{};
        std::array<double, 3> m{};
    };
    struct Node {
        std::uint32_t node;
        Point2 place;
    };

    void add_side(std::size_t i, std::size_t j, std::size_t own, std::uint32_t opposite, Point2 far)
    {
        const std::size_t other = nodes_.size();
        nodes_.push_back({opposite, far});
        Bend bend;
        for (const std::size_t wing : {own, other}) {
            const Point2 p = nodes_[i].place, q = nodes_[j].place, r = nodes_[wing].place;
            const double at_i = cotangent(q - p, r - p), at_j = cotangent(p - q, r - q);
            bend.c[i] += at_j;
            bend.c[j] += at_i;
            bend.c[wing] -= at_i + at_j;
        }
        for (std::size_t k = 0; k < nodes_.size(); ++k) {
            const Point2 p = nodes_[k].place;
            bend.m[0] += bend.c[k] * p.x * p.x / 2;
            bend.m[1] += bend.c[k] * p.x * p.y;
            bend.m[2] += bend.c[k] * p.y * p.y / 2;
        }
        bends_.push_back(bend);
    }

    double area_ = 0;
    std::vector<Node> nodes_;
    std::vector<Bend> bends_;
};

}  // namespace

void add_bending(std::vector<Spring>& springs, const SheetShape& sheet, double bending_stiffness)
{
    const double dx = sheet.spacing[0], dz = sheet.spacing[1];
    const double row_weight = bending_stiffness * dz / (dx * dx * dx);
    const double column_weight = bending_stiffness * dx / (dz * dz * dz);
    const double twist_weight = 2 * bending_stiffness / (dx * dz);
    // For an edge between places k and k + 1 of `count`: in how many triples and cells it occurs.
    const auto threes = [](std::uint32_t k, std::uint32_t count) {
        return (k > 0 ? 1.0 : 0.0) + (k + 2 < count ? 1.0 : 0.0);
    };
    const auto cells = [](std::uint32_t k, std::uint32_t count) {
        return (k > 0 ? 1.0 : 0.0) + (k + 1 < count ? 1.0 : 0.0);
    };
    for (Spring& spring : springs) {
        const GridSpring at(spring, sheet);
        // (a - 2 b + c)^2 = 2 (a - b)^2 + 2 (b - c)^2 - (a - c)^2; in a cell the sides have a plus and the
        // diagonals a minus.
        const double row = row_weight * part_of(at.row, sheet.rows);
        const double column = column_weight * part_of(at.column, sheet.columns);
        if (spring.spring_class == SpringClass::shear)
            spring.bending = -twist_weight;
        else if (spring.spring_class == SpringClass::bend)
            spring.bending = at.along_row ? -row : -column;
        else if (at.along_row)
            spring.bending =
                2 * row * threes(at.column, sheet.columns) + twist_weight * cells(at.row, sheet.rows);
        else
            spring.bending =
                2 * column * threes(at.row, sheet.rows) + twist_weight * cells(at.column, sheet.columns);
    }
}

void add_bending(std::vector<Spring>& springs, std::span<const Triangle> triangles,
                 const std::vector<Vec3>& positions, double bending_stiffness)
{
    const std::vector<TriangleSide> sides = sides_of(triangles);
    std::vector<PairWeight> weights;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const BentTriangle triangle(triangles[t], t, sides, positions);
        triangle.add(bending_stiffness, weights);
    }
    std::sort(weights.begin(), weights.end(), by_ends);
    // Both lists have the same order and are merged. A pair without a spring becomes a spring with a bending
    // weight alone.
    const std::size_t known = springs.size();
    std::size_t s = 0;
    for (const PairWeight& pair : weights) {
        while (s < known && by_ends(springs[s], pair)) ++s;
        if (s < known && springs[s].i == pair.i && springs[s].j == pair.j) {
            springs[s].bending += pair.weight;
        } else if (springs.size() > known && springs.back().i == pair.i && springs.back().j == pair.j) {
            springs.back().bending += pair.weight;
        } else {
            const Vec3d d = to_double(positions[pair.j]) - to_double(positions[pair.i]);
            springs.push_back({pair.i, pair.j, SpringClass::bend, std::sqrt(dot(d, d)), 0, pair.weight});
        }
    }
    std::inplace_merge(springs.begin(), springs.begin() + static_cast<std::ptrdiff_t>(known), springs.end(),
                       by_ends);
}

void halve_border(std::vector<Spring>& springs, const SheetShape& sheet)
{
    for (Spring& spring : springs) {
        const GridSpring at(spring, sheet);
        if (at.along_row) spring.scale = part_of(at.row, sheet.rows);
        if (at.along_column) spring.scale = part_of(at.column, sheet.columns);
    }
}

void share_by_area(std::vector<double>& masses, double total, const SheetShape& sheet)
{
    const double cell = total / ((sheet.rows - 1.0) * (sheet.columns - 1.0));
    for (std::size_t i = 0; i < masses.size(); ++i)
        masses[i] = cell * part_of(static_cast<std::uint32_t>(i / sheet.columns), sheet.rows) *
                    part_of(static_cast<std::uint32_t>(i % sheet.columns), sheet.columns);
}

}  // namespace pliant
