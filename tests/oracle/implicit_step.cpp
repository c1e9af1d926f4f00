// The energy of a step as a whole, inertia and contact, and where it is least.
#include "oracle/implicit_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "oracle/differences.hpp"

namespace pliant::oracle {
namespace {

long double long_gap(const PlacedCollider& collider, const LongPoint& x)
{
    const LongPoint from_centre = x - point_of(collider.centre).cast<long double>();
    if (collider.is<Plane>()) return from_centre.dot(point_of(collider.axes[1]).cast<long double>());
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

StepInput ImplicitStep::second_order(StepInput input, const std::vector<Point>& way,
                                     const std::vector<Point>& before)
{
    input.dt *= 2.0 / 3;
    for (std::size_t i = 0; i < way.size(); ++i) {
        input.position[i] += way[i] / 3;
        input.mean_velocity.push_back((4 * input.velocity[i] - before[i]) / 3);
    }
    return input;
}

Point ImplicitStep::aim_of(int node) const
{
    const auto k = static_cast<std::size_t>(node);
    const double dt = input_.dt, decay = std::max(0.0, 1 - input_.cloth.damping * dt);
    if (input_.is_pinned[k]) return input_.destination[k] - at(node);
    const Point pushed = is_second_order() ? input_.mean_velocity[k] : Point(decay * input_.velocity[k]);
    return dt * (pushed + dt * point_of(input_.scene.gravity)) / air_weight();
}

void ImplicitStep::add_inertia(const std::vector<double>& masses)
{
    const double dt = input_.dt;
    masses_ = masses;
    start_ = aim_ = Vector::Zero(size());
    for (int i = 0; i < size() / 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Point y = aim_.segment<3>(3 * i) = aim_of(i);
        start_.segment<3>(3 * i) = input_.is_pinned[k] ? y : Point(dt * input_.velocity[k]);
        if (input_.is_pinned[k]) continue;
        const double weight = air_weight() * masses[k] / (dt * dt);
        Term term;
        term.kind = Kind::inertia;
        term.nodes = {i};
        term.energy = [=](const Vector& moved) { return weight / 2 * (moved - y).squaredNorm(); };
        term.newton = [=](const Vector&) -> Matrix { return weight * Block::Identity(); };
        terms_.push_back(std::move(term));
    }
}

std::function<double(const Vector&)> ImplicitStep::depth_of(int node, std::size_t k) const
{
    const Pressed& pressed = input_.pressed[static_cast<std::size_t>(node)];
    const bool here = pressed.collider == static_cast<int>(k);
    const double before = here ? pressed.force / input_.scene.newton_multigrid.contact_stiffness : 0;
    return [keeps = input_.cloth.thickness + before, q = at(node),
            collider = input_.colliders[k]](const Vector& moved) {
        return static_cast<double>(keeps - long_gap(collider, long_sum(q, moved)));
    };
}

std::vector<Pressed> ImplicitStep::pressed(const Vector& t) const
{
    std::vector<Pressed> found(input_.position.size());
    for (int i = 0; i < size() / 3; ++i)
        for (std::size_t k = 0; k < input_.colliders.size(); ++k) {
            const Point moved = t.segment<3>(3 * i);
            const double force =
                input_.scene.newton_multigrid.contact_stiffness * std::max(0.0, depth_of(i, k)(moved));
            Pressed& most = found[static_cast<std::size_t>(i)];
            if (is_free(3 * i) && force > most.force)
                most = {static_cast<int>(k), force, normal_of(input_.colliders[k], at(i) + moved)};
        }
    return found;
}

Point ImplicitStep::carried(int node, const PlacedCollider& collider) const
{
    const Point arm = at(node) - point_of(collider.centre);
    return input_.dt * (point_of(collider.velocity) + point_of(collider.spin).cross(arm));
}

void ImplicitStep::add_contact()
{
    const NewtonMultigridOptions& options = input_.scene.newton_multigrid;
    const double stiffness = options.contact_stiffness;
    const double slip = options.friction_speed * input_.dt;
    const bool is_new = input_.pressed.empty();
    if (is_new) input_.pressed.resize(input_.position.size());
    for (int i = 0; i < size() / 3; ++i) {
        if (input_.is_pinned[static_cast<std::size_t>(i)]) continue;
        const Point q = at(i);
        Pressed most;
        for (std::size_t k = 0; k < input_.colliders.size(); ++k) {
            const PlacedCollider& collider = input_.colliders[k];
            const auto depth = depth_of(i, k);
            corners_.emplace_back([=](const Vector& t) { return std::abs(depth(t.segment<3>(3 * i))); });
            Term term;
            term.kind = Kind::contact;
            term.nodes = {i};
            term.energy = [=](const Vector& moved) {
                const double e = std::max(0.0, depth(moved));
                return stiffness / 2 * e * e;
            };
            // Without the curvature of the surface.
            term.newton = [=](const Vector& moved) -> Matrix {
                const Point normal = normal_of(collider, q + moved);
                return (depth(moved) > 0 ? stiffness : 0) * normal * normal.transpose();
            };
            terms_.push_back(std::move(term));
            // Where nothing is known of the step before, by the depth at the start, carried on with the
            // surface.
            const Point with = carried(i, collider);
            const double force = stiffness * depth(with);
            if (is_new && force > most.force)
                most = {static_cast<int>(k), force, normal_of(collider, q + with)};
        }
        // Friction: Coulomb's, with that normal force.
        if (!is_new) most = input_.pressed[static_cast<std::size_t>(i)];
        if (most.collider < 0) continue;
        const PlacedCollider& collider = input_.colliders[static_cast<std::size_t>(most.collider)];
        const double force = collider.friction * most.force;
        const Point n = most.normal, with = carried(i, collider);
        const auto slid = [=](const Vector& moved) -> Point {
            const Point r = Point(moved) - with;
            return r - n * n.dot(r);
        };
        Term term;
        term.kind = Kind::contact;
        term.nodes = {i};
        term.energy = [=](const Vector& moved) {
            const double way = slid(moved).norm();
            return force * (way > slip ? way - slip / 2 : way * way / (2 * slip));
        };
        // Beyond `slip` it takes the force over the way for the stiffness, in every direction of the surface;
        // but none along the way where inertia is more than friction.
        const double inertia = masses_[static_cast<std::size_t>(i)] / (input_.dt * input_.dt);
        const bool slides = inertia * slid(aim_.segment<3>(3 * i)).norm() > force;
        term.newton = [=](const Vector& moved) -> Matrix {
            const Point r = slid(moved);
            const double way = r.norm();
            Block block = Block::Identity() - n * n.transpose();
            if (slides && way > slip) block -= r * r.transpose() / (way * way);
            return force / std::max(way, slip) * block;
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
