#include "oracle/implicit_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace pliant::oracle {
namespace {

constexpr std::size_t structural = 0, shear = 1, bend = 2;

/// m: of the differences that make forces. It must be small against the distance to a length where a force
/// has a corner, or be left with its stiffness times this. Lengths and gaps are therefore found to 2^-64 of 1
/// m; what is left is the rounding of a term's energy, 2^-53 of some J, over this: 1e-7 N for each J.
constexpr double force_step = 0x1p-30;

using LongPoint = Eigen::Matrix<long double, 3, 1>;
LongPoint long_sum(const Point& a, const Point& b) { return a.cast<long double>() + b.cast<long double>(); }

/// Central differences of fourth order.
Vector gradient_of(const std::function<double(const Vector&)>& f, Vector x, double h)
{
    Vector gradient(x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
        const double before = x[k];
        const auto f_at = [&](double steps) {
            x[k] = before + steps * h;
            return f(x);
        };
        gradient[k] = (8 * (f_at(1) - f_at(-1)) - (f_at(2) - f_at(-2))) / (12 * h);
        x[k] = before;
    }
    return gradient;
}

Matrix hessian_of(const std::function<double(const Vector&)>& f, Vector x, double h)
{
    Matrix hessian(x.size(), x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
        const double before = x[k];
        const auto gradient_at = [&](double steps) {
            x[k] = before + steps * h;
            return gradient_of(f, x, h);
        };
        hessian.col(k) =
            (8 * (gradient_at(1) - gradient_at(-1)) - (gradient_at(2) - gradient_at(-2))) / (12 * h);
        x[k] = before;
    }
    return (hessian + hessian.transpose()) / 2;
}

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
    /// "A slack spring keeps its stiffness along its direction": all of it, or, where it has a stiffness
    /// below its limit, from half of the limit on.
    double kept(double length) const
    {
        if (acts(length)) return 0;
        const double e = length - rest;
        const bool near = std::max(e, compressed > 0 ? -e : e) > limit * rest / 2;
        return below > 0 && limit > 0 && !near ? 0 : std::max(beyond, compressed);
    }
};

long double long_gap(const PlacedCollider& collider, const LongPoint& x)
{
    const LongPoint from_centre = x - point_of(collider.centre).cast<long double>();
    if (collider.kind == PlacedCollider::Kind::plane)
        return from_centre.dot(point_of(collider.axes[1]).cast<long double>());
    return from_centre.norm() - collider.radius;
}
double gap_of(const PlacedCollider& collider, const Point& x)
{
    return static_cast<double>(long_gap(collider, x.cast<long double>()));
}
Point normal_of(const PlacedCollider& collider, const Point& x)
{
    return gradient_of([&](const Vector& place) { return gap_of(collider, place); }, x, 0x1p-13).normalized();
}

}  // namespace

ImplicitStep::ImplicitStep(StepInput input) : input_(std::move(input))
{
    const auto* sheet = std::get_if<SheetOptions>(&input_.cloth.shape);
    if (sheet)
        add_sheet(*sheet);
    else
        add_mesh();
    if (!input_.colliders.empty()) add_contact();
}

void ImplicitStep::add_pair(int i, int j, int between, bool folds, std::function<double(const Point&)> energy,
                            std::function<Block(const Point&)> block)
{
    const bool three = between >= 0;
    Term term;
    term.nodes = three ? std::vector<int>{i, between, j} : std::vector<int>{i, j};
    const auto moved_apart = [three](const Vector& moved) -> Point {
        return moved.segment<3>(three ? 6 : 3) - moved.segment<3>(0);
    };
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
    const bool first = !pinned(i) && !pinned(between), second = !pinned(j) && !pinned(between);
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

void ImplicitStep::add_spring(std::size_t spring_class, int i, int j, int between, double rest, double part)
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
        curve.beyond = 1 / given.compliance;
        if (input_.scene.newton_multigrid.resists == Resists::both) curve.compressed = curve.beyond;
    } else {
        curve.below = given.stiffness;
    }
    if (quadratic && spring_class == bend) curve = {.rest = rest};
    const bool folds = between >= 0 && role != SpringRole::constraint;
    const Point before = at(j) - at(i);
    corners_.emplace_back([=](const Vector& t) {
        const double e = (before + t.segment<3>(3 * j) - t.segment<3>(3 * i)).norm() - rest;
        if (curve.beyond == 0) return std::abs(e);  // where the force turns round
        double nearest = std::abs(e);
        for (const double part_of_limit : {0.5, 1.0})
            nearest = std::min(nearest, std::abs(std::abs(e) - part_of_limit * curve.limit * rest));
        return nearest;
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
    // Along the direction that the spring had when the step began.
    const double c = part * given.damping / input_.dt;
    const Point n = before.normalized();
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
    const auto inside = [&](int r, int c) { return r >= 0 && r < rows && c >= 0 && c < columns; };
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const int i = node(r, c);
            const double along_row = part_of(r, rows), along_column = part_of(c, columns);
            const double slanted = std::hypot(dx, dz);
            if (inside(r, c + 1)) add_spring(structural, i, node(r, c + 1), -1, dx, along_row);
            if (inside(r + 1, c)) add_spring(structural, i, node(r + 1, c), -1, dz, along_column);
            if (inside(r + 1, c + 1)) add_spring(shear, i, node(r + 1, c + 1), -1, slanted, 1);
            if (inside(r + 1, c - 1)) add_spring(shear, i, node(r + 1, c - 1), -1, slanted, 1);
            // A sheet whose springs have numbers of their own is a mesh to the solver, which folds nothing.
            const bool folds = !halves && input_.cloth.springs.bend_model == BendModel::skip_spring;
            if (inside(r, c + 2))
                add_spring(bend, i, node(r, c + 2), folds ? node(r, c + 1) : -1, 2 * dx, along_row);
            if (inside(r + 2, c))
                add_spring(bend, i, node(r + 2, c), folds ? node(r + 1, c) : -1, 2 * dz, along_column);
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
    std::map<std::pair<int, int>, bool> bends;
    for (const auto& [edge, opposite] : edges) {
        add_spring(structural, edge.first, edge.second, -1, distance(edge.first, edge.second), 1);
        if (opposite.size() != 2) continue;
        const auto pair = std::minmax(opposite[0], opposite[1]);
        if (edges.count(pair) == 0) bends[pair] = true;
    }
    for (const auto& [pair, there] : bends)
        add_spring(bend, pair.first, pair.second, -1, distance(pair.first, pair.second), 1);
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

void ImplicitStep::add_inertia(const std::vector<double>& masses)
{
    const double dt = input_.dt;
    masses_ = masses;
    start_ = aim_ = Vector::Zero(size());
    for (int i = 0; i < size() / 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Point v = input_.velocity[k], g = point_of(input_.scene.gravity);
        const double decay = std::max(0.0, 1 - input_.cloth.damping * dt);
        if (input_.is_pinned[k]) {
            start_.segment<3>(3 * i) = aim_.segment<3>(3 * i) = input_.destination[k] - at(i);
            continue;
        }
        start_.segment<3>(3 * i) = dt * v;
        const Point y = aim_.segment<3>(3 * i) = dt * (decay * v + dt * g);
        const double weight = masses[k] / (dt * dt);
        Term term;
        term.kind = Kind::inertia;
        term.nodes = {i};
        term.energy = [=](const Vector& moved) { return weight / 2 * (moved - y).squaredNorm(); };
        term.newton = [=](const Vector&) -> Matrix { return weight * Block::Identity(); };
        terms_.push_back(std::move(term));
    }
}

void ImplicitStep::add_contact()
{
    const NewtonMultigridOptions& options = input_.scene.newton_multigrid;
    const double stiffness = options.contact_stiffness, thickness = input_.cloth.thickness;
    const double slip = options.friction_speed * input_.dt;
    for (int i = 0; i < size() / 3; ++i) {
        if (input_.is_pinned[static_cast<std::size_t>(i)]) continue;
        const Point q = at(i);
        for (const PlacedCollider& collider : input_.colliders) {
            corners_.emplace_back([=](const Vector& t) {
                return std::abs(thickness - gap_of(collider, q + t.segment<3>(3 * i)));
            });
            Term term;
            term.kind = Kind::contact;
            term.nodes = {i};
            const auto depth_at = [=](const Vector& moved) {
                return std::max(0.0L, thickness - long_gap(collider, long_sum(q, moved)));
            };
            term.energy = [=](const Vector& moved) {
                return static_cast<double>(stiffness / 2 * depth_at(moved) * depth_at(moved));
            };
            // Without the curvature of the surface.
            term.newton = [=](const Vector& moved) -> Matrix {
                const Point n = normal_of(collider, q + moved);
                return (depth_at(moved) > 0 ? stiffness : 0) * n * n.transpose();
            };
            terms_.push_back(std::move(term));
        }
        // Friction: Coulomb's, with the normal force that the last step ended with, and the collider that it
        // was of: where the node was, carried on with the surface.
        double force = 0, deepest = 0;
        Point n = Point::Zero(), carried = Point::Zero();
        for (const PlacedCollider& collider : input_.colliders) {
            const Point arm = q - point_of(collider.centre);
            const Point with = input_.dt * (point_of(collider.velocity) + point_of(collider.spin).cross(arm));
            const double depth = thickness - gap_of(collider, q + with);
            if (depth <= deepest) continue;
            deepest = depth;
            force = collider.friction * stiffness * depth;
            n = normal_of(collider, q + with);
            carried = with;
        }
        if (deepest == 0) continue;
        const auto slid = [=](const Vector& moved) -> Point {
            const Point r = Point(moved) - carried;
            return r - n * n.dot(r);
        };
        Term term;
        term.kind = Kind::contact;
        term.nodes = {i};
        term.energy = [=](const Vector& moved) {
            const double way = slid(moved).norm();
            return force * (way > slip ? way - slip / 2 : way * way / (2 * slip));
        };
        // Beyond `slip` it takes the force over the way for the stiffness, in every direction of the surface.
        term.newton = [=](const Vector& moved) -> Matrix {
            const double way = slid(moved).norm();
            return force / std::max(way, slip) * (Block::Identity() - n * n.transpose());
        };
        terms_.push_back(std::move(term));
    }
}

namespace {

Vector moved_of(const Term& term, const Vector& t)
{
    Vector moved(static_cast<Eigen::Index>(3 * term.nodes.size()));
    for (std::size_t k = 0; k < term.nodes.size(); ++k)
        moved.segment<3>(static_cast<Eigen::Index>(3 * k)) = t.segment<3>(3 * term.nodes[k]);
    return moved;
}

}  // namespace

double ImplicitStep::load_length() const
{
    double load = 0, lightest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < size() / 3; ++i) {
        const double mass = masses_[static_cast<std::size_t>(i)];
        if (!is_free(3 * i)) continue;
        load += mass * (aim_ - start_).segment<3>(3 * i).squaredNorm();
        lightest = std::min(lightest, mass);
    }
    return std::sqrt(load / lightest);
}

double ImplicitStep::energy(const Vector& t) const
{
    return energy(t, Kind::spring) + energy(t, Kind::inertia) + energy(t, Kind::contact);
}

double ImplicitStep::energy(const Vector& t, Kind kind) const
{
    double sum = 0;
    for (const Term& term : terms_)
        if (term.kind == kind) sum += term.energy(moved_of(term, t));
    return sum;
}

Vector ImplicitStep::force(const Vector& t) const
{
    Vector force = Vector::Zero(size());
    for (const Term& term : terms_) {
        const Vector gradient = gradient_of(term.energy, moved_of(term, t), force_step);
        for (std::size_t k = 0; k < term.nodes.size(); ++k)
            force.segment<3>(3 * term.nodes[k]) -= gradient.segment<3>(static_cast<Eigen::Index>(3 * k));
    }
    for (int k = 0; k < size(); ++k)
        if (!is_free(k)) force[k] = 0;
    return force;
}

Matrix ImplicitStep::sum_of(const Vector& t,
                            const std::function<Matrix(const Term&, const Vector&)>& matrix) const
{
    Matrix sum = Matrix::Zero(size(), size());
    for (const Term& term : terms_) {
        const Matrix part = matrix(term, moved_of(term, t));
        for (std::size_t r = 0; r < term.nodes.size(); ++r)
            for (std::size_t c = 0; c < term.nodes.size(); ++c)
                sum.block<3, 3>(3 * term.nodes[r], 3 * term.nodes[c]) +=
                    part.block<3, 3>(static_cast<Eigen::Index>(3 * r), static_cast<Eigen::Index>(3 * c));
    }
    for (int k = 0; k < size(); ++k)
        if (!is_free(k)) sum.row(k).setZero(), sum.col(k).setZero();
    return sum;
}

Matrix ImplicitStep::hessian(const Vector& t, double h) const
{
    return sum_of(t,
                  [&](const Term& term, const Vector& moved) { return hessian_of(term.energy, moved, h); });
}
Matrix ImplicitStep::newton_matrix(const Vector& t) const
{
    return sum_of(t, [](const Term& term, const Vector& moved) { return term.newton(moved); });
}
Matrix ImplicitStep::coarse_matrix(const Vector& t) const
{
    return sum_of(t, [](const Term& term, const Vector& moved) {
        return term.coarse ? term.coarse(moved) : term.newton(moved);
    });
}

double ImplicitStep::nearest_corner(const Vector& t) const
{
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& corner : corners_) nearest = std::min(nearest, corner(t));
    return nearest;
}

Vector ImplicitStep::first_look_force(const Vector& t) const
{
    Vector force = Vector::Zero(size());
    for (int i = 0; i < size() / 3; ++i)
        for (const PlacedCollider& collider : input_.colliders) {
            const Point x = at(i) + t.segment<3>(3 * i), aimed = at(i) + aim_.segment<3>(3 * i);
            const double gap = gap_of(collider, x), thickness = input_.cloth.thickness;
            if (!is_free(3 * i) || gap_of(collider, aimed) >= thickness || gap <= thickness) continue;
            force.segment<3>(3 * i) +=
                input_.scene.newton_multigrid.contact_stiffness * (thickness - gap) * normal_of(collider, x);
        }
    return force;
}

Matrix ImplicitStep::first_look_matrix(const Vector& t) const
{
    Matrix matrix = Matrix::Zero(size(), size());
    for (int i = 0; i < size() / 3; ++i)
        for (const PlacedCollider& collider : input_.colliders) {
            const Point x = at(i) + t.segment<3>(3 * i), aimed = at(i) + aim_.segment<3>(3 * i);
            const double thickness = input_.cloth.thickness;
            if (!is_free(3 * i) || gap_of(collider, aimed) >= thickness || gap_of(collider, x) <= thickness)
                continue;
            const Point n = normal_of(collider, x);
            matrix.block<3, 3>(3 * i, 3 * i) +=
                input_.scene.newton_multigrid.contact_stiffness * n * n.transpose();
        }
    return matrix;
}

Vector ImplicitStep::minimum(int& steps) const
{
    std::vector<int> free;
    for (int k = 0; k < size(); ++k)
        if (is_free(k)) free.push_back(k);
    Vector t = start_;
    for (steps = 1; steps <= 200; ++steps) {
        const Vector f = force(t)(free);
        Eigen::LLT<Matrix> factor(hessian(t, 0x1p-18)(free, free));
        if (factor.info() != Eigen::Success) factor.compute(newton_matrix(t)(free, free));
        const Vector way = factor.solve(f);
        const double before = energy(t), gain = way.dot(f);
        if (way.lpNorm<Eigen::Infinity>() < 2e-9) return t;
        double part = 1;
        Vector next = t;
        for (; part > 1e-6; part /= 2) {
            next(free) = t(free) + part * way;
            // Roundings of E hide the last digits of what is gained.
            if (energy(next) <= before - 1e-4 * part * gain + 1e-14 * std::abs(before)) break;
        }
        t = next;
    }
    return t;
}

}  // namespace pliant::oracle
