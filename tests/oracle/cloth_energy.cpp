// What springs and bending give to the energy of a step.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "oracle/differences.hpp"

namespace pliant::oracle {
namespace {

constexpr std::size_t structural = 0, shear = 1, bend = 2;

/// Spring j - i: B at (i, i) and (j, j), -B at (i, j) and (j, i).
Matrix coupled(const Block& b)
{
    Matrix a(6, 6);
    a << b, -b, -b, b;
    return a;
}
/// As a bend spring is folded: k (a - c)^2 as 2 k ((a - b)^2 + (b - c)^2).
Matrix folded(const Block& b, bool first, bool second)
{
    Matrix a = Matrix::Zero(9, 9);
    if (first) a.topLeftCorner(6, 6) += 2 * coupled(b);
    if (second) a.bottomRightCorner(6, 6) += 2 * coupled(b);
    return a;
}

/// The law "limited spring":  E = k e^2 / 2 + K max(0, e - s l0)^2 / 2 + K' max(0, -e - s l0)^2 / 2
struct Curve {
    double below = 0, limit = 0, beyond = 0, compressed = 0, rest = 0;
    double kept_part = 1;

    double energy(long double length) const
    {
        const long double e = length - rest, slack = limit * rest, none = 0;
        const long double over = std::max(none, e - slack), under = std::max(none, -e - slack);
        return static_cast<double>((below * e * e + beyond * over * over + compressed * under * under) / 2);
    }
    bool acts(double length) const
    {
        const double e = length - rest;
        return e > limit * rest || (compressed > 0 && -e > limit * rest);
    }
    /// "A slack spring keeps its stiffness along its direction": all of it, of limits of a mesh that remember
    /// 0.3 if it is slack by more than 2^-17, and where it has a stiffness below its limit none.
    double kept(double length) const
    {
        return acts(length) || (below > 0 && limit > 0) ? 0
                                                        : part_kept(length) * std::max(beyond, compressed);
    }
    double part_kept(double length) const
    {
        const double e = length - rest, farther = compressed > 0 ? std::abs(e) : e;
        return farther - limit * rest > -0x1p-17 * rest ? 1 : kept_part;
    }
};

}  // namespace

void ImplicitStep::add_pair(int i, int j, const std::vector<int>& between, bool folds,
                            std::function<double(const Point&)> energy,
                            std::function<Block(const Point&)> block)
{
    const bool three = between.size() == 1;
    Term term;
    term.nodes = {i};
    term.nodes.insert(term.nodes.end(), between.begin(), between.end());
    term.nodes.push_back(j);
    const auto moved_apart = [](const Vector& moved) -> Point { return moved.tail<3>() - moved.head<3>(); };
    term.energy = [energy, moved_apart](const Vector& moved) { return energy(moved_apart(moved)); };
    const auto straight = [block, moved_apart, three](const Vector& moved) -> Matrix {
        const Matrix a = coupled(block(moved_apart(moved)));
        if (!three) return a;
        Matrix all = Matrix::Zero(9, 9);
        for (const int r : {0, 1})
            for (const int c : {0, 1}) all.block<3, 3>(6 * r, 6 * c) = a.block<3, 3>(3 * r, 3 * c);
        return all;
    };
    const auto bent = [block, moved_apart](const Vector& moved) -> Matrix {
        return folded(block(moved_apart(moved)), true, true);
    };
    // A half that leads to a pinned node is left out of what coarser levels are made of.
    const auto pinned = [&](int node) {
        return node >= 0 && input_.is_pinned[static_cast<std::size_t>(node)];
    };
    const int middle = three ? between.front() : -1;
    const bool first = !pinned(i) && !pinned(middle), second = !pinned(j) && !pinned(middle);
    const auto bent_between_free = [=](const Vector& moved) -> Matrix {
        return folded(block(moved_apart(moved)), first, second);
    };
    if (folds)
        term.newton = bent;
    else
        term.newton = straight;
    if (three && !folds) term.coarse = bent_between_free;
    terms_.push_back(std::move(term));
}

void ImplicitStep::add_spring(std::size_t spring_class, int i, int j, const std::vector<int>& between,
                              double rest, double part)
{
    const Springs& springs = input_.cloth.springs;
    const SpringParameters& given = spring_class == structural ? springs.structural
                                    : spring_class == shear    ? springs.shear
                                                               : springs.bend;
    const bool quadratic = springs.bend_model == BendModel::quadratic;
    SpringRole role = given.role;
    if (role == SpringRole::automatic)
        role = input_.scene.method == Method::constraint && spring_class != bend ? SpringRole::constraint
                                                                                 : SpringRole::spring;
    if (role == SpringRole::off) return;
    Curve curve{.rest = rest};
    if (role == SpringRole::constraint) {
        curve.limit = given.limit;
        curve.below = given.limit > 0 ? given.stiffness : 0;
        // Four times as stiff where a node of a mesh hangs by it.
        const auto is_pinned = [&](int node) {
            return bool{input_.is_pinned[static_cast<std::size_t>(node)]};
        };
        const bool holds = !input_.triangles.empty() && is_pinned(i) != is_pinned(j);
        const double softest = input_.softest * (holds ? 4 : 1);
        const double soft = spring_class != bend && softest > 0 ? 1 / softest : 0;
        curve.beyond = 1 / (given.compliance + soft);
        if (soft > 0 && !input_.triangles.empty()) curve.kept_part = 0.3;
        if (input_.scene.newton_multigrid.resists == Resists::both) curve.compressed = curve.beyond;
    } else {
        curve.below = given.stiffness;
    }
    if (quadratic && spring_class == bend) curve = {.rest = rest};
    const bool folds = !between.empty() && role != SpringRole::constraint;
    const Point before = at(j) - at(i);
    corners_.emplace_back([=](const Vector& t) {
        const double e = (before + t.segment<3>(3 * j) - t.segment<3>(3 * i)).norm() - rest;
        if (curve.beyond == 0) return std::abs(e);  // where the force turns round
        return std::min(std::abs(e), std::abs(std::abs(e) - curve.limit * rest));
    });
    add_pair(
        i, j, between, folds,
        [=](const Point& apart) { return part * curve.energy(long_sum(before, apart).norm()); },
        [=](const Point& apart) -> Block {
            const Point d = before + apart;
            const double l = d.norm();
            Vector length(1);
            length[0] = l;
            // The curve is made of parabolas, so that its differences are exact but for rounding.
            const auto energy = [&](const Vector& a) { return curve.energy(a[0]); };
            const double along = hessian_of(energy, length, 0x1p-17)(0, 0) + curve.kept(l);
            const double across = std::max(0.0, gradient_of(energy, length, 0x1p-20)[0] / l);
            const Point n = d / l;
            return part * (along * n * n.transpose() + across * (Block::Identity() - n * n.transpose()));
        });
    if (given.damping == 0) return;
    // Along the direction that the spring had when the step began, and of second order along the one that
    // inertia alone takes it to.
    const double c = part * given.damping / input_.dt;
    const Point then = is_second_order() ? Point(before + aim_of(j) - aim_of(i)) : before;
    const Point n = then.normalized();
    add_pair(
        i, j, between, folds, [=](const Point& apart) { return c * std::pow(n.dot(apart), 2) / 2; },
        [=](const Point&) -> Block { return c * n * n.transpose(); });
}

/// weight / 2 |sum of factors x|^2
void ImplicitStep::add_square(std::vector<int> nodes, const std::vector<double>& factors, double weight)
{
    Point before = Point::Zero();
    for (std::size_t k = 0; k < nodes.size(); ++k) before += factors[k] * at(nodes[k]);
    Term term;
    term.nodes = std::move(nodes);
    term.energy = [=](const Vector& moved) {
        Point sum = before;
        for (std::size_t k = 0; k < factors.size(); ++k)
            sum += factors[k] * moved.segment<3>(static_cast<Eigen::Index>(3 * k));
        return weight / 2 * sum.squaredNorm();
    };
    term.newton = [energy = term.energy](const Vector& moved) { return hessian_of(energy, moved, 0x1p-13); };
    terms_.push_back(std::move(term));
}

void ImplicitStep::add_sheet(const SheetOptions& sheet)
{
    const int rows = static_cast<int>(sheet.rows), columns = static_cast<int>(sheet.columns);
    const double dx = sheet.width / (columns - 1), dz = sheet.height / (rows - 1);
    const bool halves = sheet.border == SheetBorder::half;
    const auto part_of = [&](int k, int count) { return halves && (k == 0 || k == count - 1) ? 0.5 : 1.0; };
    const auto node = [&](int r, int c) { return r * columns + c; };
    const auto between = [](bool folds, int middle) {
        return folds ? std::vector<int>{middle} : std::vector<int>{};
    };
    const auto inside = [&](int r, int c) { return r >= 0 && r < rows && c >= 0 && c < columns; };
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const int i = node(r, c);
            const double along_row = part_of(r, rows), along_column = part_of(c, columns);
            const double slanted = std::hypot(dx, dz);
            if (inside(r, c + 1)) add_spring(structural, i, node(r, c + 1), {}, dx, along_row);
            if (inside(r + 1, c)) add_spring(structural, i, node(r + 1, c), {}, dz, along_column);
            if (inside(r + 1, c + 1)) add_spring(shear, i, node(r + 1, c + 1), {}, slanted, 1);
            if (inside(r + 1, c - 1)) add_spring(shear, i, node(r + 1, c - 1), {}, slanted, 1);
            // A sheet whose springs have numbers of their own is a mesh to the solver, which folds nothing.
            const bool folds = !halves && input_.cloth.springs.bend_model == BendModel::skip_spring;
            if (inside(r, c + 2))
                add_spring(bend, i, node(r, c + 2), between(folds, node(r, c + 1)), 2 * dx, along_row);
            if (inside(r + 2, c))
                add_spring(bend, i, node(r + 2, c), between(folds, node(r + 1, c)), 2 * dz, along_column);
        }
    if (input_.cloth.springs.bend_model == BendModel::quadratic) {
        // B/2 (|x_uu|^2 + |x_vv|^2 + 2 |x_uv|^2)
        const double b = input_.cloth.springs.bending_stiffness;
        const auto border = [](int k, int count) { return k == 0 || k == count - 1 ? 0.5 : 1.0; };
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < columns; ++c) {
                if (inside(r, c + 2))
                    add_square({node(r, c), node(r, c + 1), node(r, c + 2)}, {1, -2, 1},
                               b * border(r, rows) * dz / std::pow(dx, 3));
                if (inside(r + 2, c))
                    add_square({node(r, c), node(r + 1, c), node(r + 2, c)}, {1, -2, 1},
                               b * border(c, columns) * dx / std::pow(dz, 3));
                if (inside(r + 1, c + 1))
                    add_square({node(r, c), node(r, c + 1), node(r + 1, c), node(r + 1, c + 1)},
                               {1, -1, -1, 1}, 2 * b / (dx * dz));
            }
    }
    const double area = sheet.width * sheet.height, density = input_.cloth.density.value_or(0.3);
    std::vector<double> masses;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c)
            masses.push_back(input_.cloth.node_mass
                                 ? *input_.cloth.node_mass
                                 : density * (halves ? dx * dz * part_of(r, rows) * part_of(c, columns)
                                                     : area / (rows * columns)));
    add_inertia(masses);
}

void ImplicitStep::add_mesh()
{
    // Edges, each with the vertices opposite to it.
    std::map<std::pair<int, int>, std::vector<int>> edges;
    const auto ordered = [](std::uint32_t a, std::uint32_t b) {
        return std::pair(static_cast<int>(std::min(a, b)), static_cast<int>(std::max(a, b)));
    };
    std::vector<double> masses(input_.position.size(), 0.0);
    for (const Triangle& t : input_.triangles) {
        for (std::size_t k = 0; k < 3; ++k)
            edges[ordered(t[k], t[(k + 1) % 3])].push_back(static_cast<int>(t[(k + 2) % 3]));
        const double area =
            (input_.rest[t[1]] - input_.rest[t[0]]).cross(input_.rest[t[2]] - input_.rest[t[0]]).norm() / 2;
        for (const std::uint32_t node : t) masses[node] += area * input_.cloth.density.value_or(0.3) / 3;
    }
    if (input_.cloth.node_mass) std::fill(masses.begin(), masses.end(), *input_.cloth.node_mass);
    const auto distance = [&](int i, int j) {
        return (input_.rest[static_cast<std::size_t>(i)] - input_.rest[static_cast<std::size_t>(j)]).norm();
    };
    std::map<std::pair<int, int>, std::vector<int>> bends;  ///< with what is between
    const auto is_free = [&](int node) { return !input_.is_pinned[static_cast<std::size_t>(node)]; };
    const Springs& springs = input_.cloth.springs;
    const bool folds = input_.scene.method != Method::acad && springs.bend_model == BendModel::skip_spring &&
                       springs.bend.role != SpringRole::constraint;
    for (const auto& [edge, opposite] : edges) {
        add_spring(structural, edge.first, edge.second, {}, distance(edge.first, edge.second), 1);
        if (opposite.size() != 2) continue;
        const auto pair = std::minmax(opposite[0], opposite[1]);
        if (edges.count(pair) > 0) continue;
        const bool is_folded = folds && is_free(pair.first) && is_free(pair.second);
        // By the one or the other end of the side, in turn.
        const auto number = [&](int vertex) { return input_.numbers[static_cast<std::size_t>(vertex)]; };
        const int first = number(edge.first), second = number(edge.second);
        const bool is_even = (number(pair.first) + number(pair.second) + first + second) % 2 == 0;
        const bool by_first = is_even == (first < second);
        bends.emplace(pair,
                      is_folded ? std::vector<int>{by_first ? edge.first : edge.second} : std::vector<int>{});
    }
    for (const auto& [pair, between] : bends)
        add_spring(bend, pair.first, pair.second, between, distance(pair.first, pair.second), 1);
    if (input_.cloth.springs.bend_model == BendModel::quadratic)
        for (std::size_t t = 0; t < input_.triangles.size(); ++t) add_curvature(t);
    add_inertia(masses);
}

/// B/2 A |S|^2 of a triangle: S is the least curvature with which its sides are bent as they are. How much a
/// side is bent is a sum over the four nodes of its two triangles, unfolded into a plane, which is zero for
/// whatever is flat there; that says all but its scale, which drops out of S.
void ImplicitStep::add_curvature(std::size_t triangle)
{
    using Point2 = Eigen::Vector2d;
    const Triangle& t = input_.triangles[triangle];
    const auto rest = [&](std::uint32_t vertex) { return input_.rest[vertex]; };
    const Point origin = rest(t[0]), u = (rest(t[1]) - origin).normalized();
    const Point v = (rest(t[2]) - origin - u * u.dot(rest(t[2]) - origin)).normalized();
    const auto flat = [&](const Point& x) { return Point2(u.dot(x - origin), v.dot(x - origin)); };
    std::vector<int> nodes;
    std::vector<Point2> places;
    for (const std::uint32_t corner : t) {
        nodes.push_back(static_cast<int>(corner));
        places.push_back(flat(rest(corner)));
    }
    std::vector<Vector> sides;  // factors by place in `nodes`
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t other = 0; other < input_.triangles.size(); ++other) {
            if (other == triangle) continue;
            const Triangle& s = input_.triangles[other];
            const auto has = [&](std::uint32_t vertex) { return std::count(s.begin(), s.end(), vertex) > 0; };
            if (!has(t[k]) || !has(t[(k + 1) % 3])) continue;
            const std::uint32_t wing = *std::find_if(s.begin(), s.end(), [&](std::uint32_t vertex) {
                return vertex != t[k] && vertex != t[(k + 1) % 3];
            });
            // Unfolded: as far along the side as it is, and as far from it on the side away from the own
            // corner.
            const Point2 p = places[k], side = (places[(k + 1) % 3] - p).normalized();
            const Point2 own = places[(k + 2) % 3] - p, inward = (own - side * side.dot(own)).normalized();
            const Point along = (rest(t[(k + 1) % 3]) - rest(t[k])).normalized(), d = rest(wing) - rest(t[k]);
            nodes.push_back(static_cast<int>(wing));
            places.push_back(p + side * along.dot(d) - inward * (d - along * along.dot(d)).norm());
            // Zero for 1, x and y: the kernel of three equations in four unknowns.
            const std::size_t four[] = {k, (k + 1) % 3, (k + 2) % 3, nodes.size() - 1};
            Eigen::Matrix<double, 3, 4> equations;
            for (int c = 0; c < 4; ++c) equations.col(c) << 1, places[four[c]];
            const Eigen::Vector4d kernel = equations.fullPivLu().kernel().col(0);
            Vector factors = Vector::Zero(6);
            for (int c = 0; c < 4; ++c) factors[static_cast<Eigen::Index>(four[c])] = kernel[c];
            sides.push_back(factors);
        }
    if (sides.empty()) return;
    // A surface x = 1/2 r . S r bends a side by m . (S11, sqrt 2 S12, S22), whose norm is that of S.
    Matrix m(static_cast<Eigen::Index>(sides.size()), 3);
    for (std::size_t a = 0; a < sides.size(); ++a) {
        Eigen::Vector3d row = Eigen::Vector3d::Zero();
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            const double x = places[k].x(), y = places[k].y(), f = sides[a][static_cast<Eigen::Index>(k)];
            row += f * Eigen::Vector3d(x * x / 2, x * y / std::sqrt(2.0), y * y / 2);
        }
        m.row(static_cast<Eigen::Index>(a)) = row;
    }
    const Matrix least = m.completeOrthogonalDecomposition().pseudoInverse();
    const double area = (rest(t[1]) - origin).cross(rest(t[2]) - origin).norm() / 2;
    for (Eigen::Index row = 0; row < 3; ++row) {
        std::vector<double> factors(nodes.size(), 0.0);
        for (std::size_t a = 0; a < sides.size(); ++a)
            for (std::size_t k = 0; k < nodes.size(); ++k)
                factors[k] +=
                    least(row, static_cast<Eigen::Index>(a)) * sides[a][static_cast<Eigen::Index>(k)];
        add_square(nodes, factors, input_.cloth.springs.bending_stiffness * area);
    }
}

}  // namespace pliant::oracle
