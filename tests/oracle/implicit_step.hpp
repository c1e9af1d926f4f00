// One implicit step of a cloth, dense and in double, written from docs/physics.md ("Springs and rest
// lengths", "Bending", "Masses", "Constraints") and from nothing that the solver is made of: no law, no
// kernel, no list of springs. It is an energy E(t) of the displacement t, a sum of small terms. Forces and
// the exact Hessian are differences of it. What Newton's method takes for its Hessian is made of the same
// differences, and of what the documentation says that it does otherwise.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Dense>

#include "body/collider_motion.hpp"
#include "pliant/scene.hpp"

namespace pliant::oracle {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using Point = Eigen::Vector3d;
using Block = Eigen::Matrix3d;

inline Point point_of(Vec3d a) { return {a.x, a.y, a.z}; }

/// What a node's contact with a collider is known to be.
struct Pressed {
    int collider = -1;
    double force = 0;  ///< N
    Point normal = Point::Zero();
};

/// What a step starts from: lists by vertex, of a sheet by node, row by row.
struct StepInput {
    Cloth cloth;
    Scene scene;                           ///< gravity, and the options of the solver
    std::vector<Point> rest = {};          ///< m: of a mesh, where its vertices were placed
    std::vector<Triangle> triangles = {};  ///< of a mesh
    std::vector<int> numbers = {};         ///< of its vertices, as the cloth orders them
    double dt = 0;                         ///< s, of a step of second order two thirds of it
    double softest = 0;  ///< N/m: what corrects limits that remember, before their compliance; 0: penalty
    std::vector<Point> position = {}, velocity = {};  ///< m, m/s; positions of second order are q
    /// m/s: of second order, what a node without forces would end with; empty: the velocity
    std::vector<Point> mean_velocity = {};
    std::vector<bool> is_pinned = {};
    std::vector<Point> destination = {};  ///< m: where a pinned node is at the end of the step
    std::vector<PlacedCollider> colliders = {};
    std::vector<Pressed> pressed = {};  ///< empty where no step has been made
};

enum class Kind { spring, inertia, contact };  ///< contact: and friction

/// A part of the energy. `moved` is the displacements of its nodes, one after the other.
struct Term {
    Kind kind = Kind::spring;
    std::vector<int> nodes;
    std::function<double(const Vector& moved)> energy;  ///< J
    std::function<Matrix(const Vector& moved)> newton;  ///< N/m: what stands for its Hessian
    /// N/m: the same for the couplings that a coarser level is made of; empty where that is no other
    std::function<Matrix(const Vector& moved)> coarse = {};
};

class ImplicitStep {
public:
    explicit ImplicitStep(StepInput input);
    /// A step of second order after one of the same length, in which nodes went `way` m and which they began
    /// with the velocity `before`, m/s: of first order in other numbers.
    static StepInput second_order(StepInput input, const std::vector<Point>& way,
                                  const std::vector<Point>& before);

    int size() const { return static_cast<int>(3 * input_.position.size()); }
    bool is_free(int number) const { return !input_.is_pinned[static_cast<std::size_t>(number / 3)]; }
    /// The displacement that Newton's method starts from, and the one that inertia alone would give; m.
    const Vector& start() const { return start_; }
    const Vector& aim() const { return aim_; }

    /// m: how far the lightest node would be from rest with all the energy that inertia has at the start.
    double load_length() const;

    double energy(const Vector& t) const;
    double energy(const Vector& t, Kind kind) const;
    /// -dE/dt, N. As in all that follows, numbers of pinned nodes are 0.
    Vector force(const Vector& t) const;
    /// The exact Hessian of E, N/m, by differences over some times `h` m.
    Matrix hessian(const Vector& t, double h) const;
    /// What Newton's method takes for it, and what couples the nodes for the sake of coarser levels.
    Matrix newton_matrix(const Vector& t) const;
    Matrix coarse_matrix(const Vector& t) const;

    /// How far, in m, the nearest spring is from a length where its force or its stiffness jumps: differences
    /// mean something only where that is more than they reach.
    double nearest_corner(const Vector& t) const;

    /// By what each node is pressed at the displacement t.
    std::vector<Pressed> pressed(const Vector& t) const;
    const StepInput& input() const { return input_; }

    /// The displacement with the least E, by Newton's method with dense factorisations. `steps` is how many
    /// it took; it gives up after 200.
    Vector minimum(int& steps) const;

private:
    void add_sheet(const SheetOptions& sheet);
    void add_mesh();
    void add_pair(int i, int j, const std::vector<int>& between, bool folds,
                  std::function<double(const Point&)> energy, std::function<Block(const Point&)> block);
    void add_spring(std::size_t spring_class, int i, int j, const std::vector<int>& between, double rest,
                    double part);
    void add_square(std::vector<int> nodes, const std::vector<double>& factors, double weight);
    void add_curvature(std::size_t triangle);
    void add_inertia(const std::vector<double>& masses);
    void add_contact();
    /// m, of the node's displacement: how deep it is in a collider, and what it is pressed by already makes
    /// of that.
    std::function<double(const Vector& moved)> depth_of(int node, std::size_t collider) const;
    /// m: the way of a collider's surface under a node
    Point carried(int node, const PlacedCollider& collider) const;
    Point aim_of(int node) const;
    /// What inertia weighs more for the air that takes of the velocity at the end, at second order.
    double air_weight() const { return is_second_order() ? 1 + input_.cloth.damping * input_.dt : 1; }
    bool is_second_order() const { return !input_.mean_velocity.empty(); }
    Point at(int node) const { return input_.position[static_cast<std::size_t>(node)]; }
    Matrix sum_of(const Vector& t, const std::function<Matrix(const Term&, const Vector&)>& matrix) const;

    StepInput input_;
    Vector start_, aim_;
    std::vector<double> masses_;  ///< kg
    std::vector<Term> terms_;
    std::vector<std::function<double(const Vector& t)>> corners_;  ///< by spring: m to the nearest
};

}  // namespace pliant::oracle
