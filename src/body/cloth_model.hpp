// A cloth made ready for stepping: nodes, springs, triangles and what a node needs to find them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "body/body_model.hpp"
#include "body/hierarchy.hpp"
#include "pliant/scene.hpp"

namespace pliant {

enum class SpringClass : std::uint32_t {
    structural = 0,
    shear = 1,  ///< of a soft body: the springs across its inside
    bend = 2
};
constexpr std::size_t spring_class_count = 3;

/// A spring between nodes i < j.
struct Spring {
    std::uint32_t i = 0, j = 0;
    SpringClass spring_class = SpringClass::structural;
    double rest_length = 0;  ///< m
    double scale = 1;        ///< multiplies stiffness and damping of its class
    /// N/m, may be negative: of the quadratic bending energy, bending / 2 (x_j - x_i)^2, see bending.hpp
    double bending = 0;
};

/// One of the up to 12 springs of a sheet's node.
struct SheetNeighbour {
    int row_offset = 0, column_offset = 0;
    SpringClass spring_class = SpringClass::structural;
    int rest = 0;  ///< index into SheetShape::rest_lengths
};

/// The canonical order in which every backend adds a node's springs: by the neighbour's index, that is
/// backward neighbours (the first six) in row order, then forward ones.
inline constexpr SheetNeighbour sheet_neighbours[12] = {
    {-2, 0, SpringClass::bend, 4},      {-1, -1, SpringClass::shear, 2}, {-1, 0, SpringClass::structural, 1},
    {-1, 1, SpringClass::shear, 2},     {0, -2, SpringClass::bend, 3},   {0, -1, SpringClass::structural, 0},
    {0, 1, SpringClass::structural, 0}, {0, 2, SpringClass::bend, 3},    {1, -1, SpringClass::shear, 2},
    {1, 0, SpringClass::structural, 1}, {1, 1, SpringClass::shear, 2},   {2, 0, SpringClass::bend, 4},
};

struct SheetShape {
    std::uint32_t rows = 0, columns = 0;
    /// m: along a row, along a column, diagonal, two along a row, two along a column
    std::array<double, 5> rest_lengths{};
};

/// Constant over a run, but for what Simulation changes per frame (the length of a step).
struct ClothParameters {
    std::array<double, spring_class_count> stiffness{};       ///< N/m
    std::array<double, spring_class_count> spring_damping{};  ///< N s/m
    Vec3d gravity;                                            ///< m/s2
    Vec3d wind;                                               ///< m/s
    double air_density = 0;                                   ///< kg/m3
    double drag = 0, lift = 0;
    double damping = 0;    ///< 1/s
    double thickness = 0;  ///< m
    friend bool operator==(const ClothParameters&, const ClothParameters&) = default;
};

/// What the constraint methods know of a class of springs: as LimitCurve of laws/limit.law.glsl.
struct LimitedSprings {
    bool exists = false;
    double below = 0;  ///< N/m
    double limit = 0;
    double beyond = 0;      ///< N/m
    double compressed = 0;  ///< N/m

    /// LimitCurve::kind of laws/limit.law.glsl.
    int curve_kind() const
    {
        if (beyond == 0 && compressed == 0) return 1;
        return below == 0 && limit == 0 && compressed == 0 ? 2 : 0;
    }
};

/// A node that a moving pin holds.
struct AttachedNode {
    std::uint32_t node = 0;
    std::uint32_t motion = 0;  ///< index into ClothModel::motions
    Vec3d arm;                 ///< m, from the centre of the nodes that the pin holds, at the start
};
struct AttachmentMotion {
    Vec3d centre;  ///< m
    std::vector<Keyframe> keyframes;
};

/// Methods that step by the constraint solver.
constexpr bool uses_solver(Method method) { return method == Method::constraint || method == Method::acad; }

/// The method whose passes a scene is stepped by: implicit Euler is that of constraints, without any.
inline Method stepped_method(const Scene& scene)
{
    return scene.integrator == Integrator::implicit_euler ? Method::constraint : scene.method;
}

class ClothModel {
public:
    ClothModel(const Cloth& cloth, const Scene& scene);

    std::uint32_t node_count() const { return static_cast<std::uint32_t>(masses.size()); }
    /// Whether limits of a class remember their forces from step to step: a renewed_limit of
    /// laws/limit.law.glsl.
    bool remembers(SpringClass of) const;
    bool remembers_any() const { return remembers(SpringClass::structural) || remembers(SpringClass::shear); }
    /// Whether all springs whose stretch is measured are such limits, and softer in steps of so many seconds
    /// than by their compliance; and the largest limit.
    bool does_not_stretch(double step_length) const;
    double largest_limit() const;
    /// N/m: the softest stiffness by which such a limit is made right, in steps of so many seconds; and of
    /// springs of a class, with their compliance.
    double softest_limit(double step_length) const;
    /// The softest limits, of m n^2 / dt^2, that pass a pull on through all n springs across the cloth in a
    /// step, where colliders hold it up (docs/physics.md, "Constraints").
    static constexpr double firm_limit = 18.4;
    /// How many times as stiff those are on a mesh that hold a node to a pinned one: what hangs there hangs
    /// by them alone, and a jerk stretches them by the change of force over their stiffness.
    static constexpr double held_limit = 4;
    /// m: how far a polish takes a node at most where nothing but inertia resists (newton_polish). Of a mesh
    /// a twenty-fifth of a spring, which stretches one by 0.08 %, and both its nodes by 0.3 %; sheets have no
    /// bound.
    double polish_reach() const { return is_sheet() ? 1e9 : 0.04 * length_across / springs_across; }
    /// The part of its stiffness that a slack limit which remembers keeps in Newton's matrix. On a mesh half
    /// of them are slack, and hold up what should fall; a sheet takes more iterations with less than all.
    double kept_when_slack() const { return is_sheet() ? 1 : 0.3; }
    double held_softest_limit(double step_length) const  ///< N/m, with the compliance
    {
        const double softest = held_limit * softest_limit(step_length);
        return softest / (1 + softest / limited[0].beyond);
    }
    double softest_limit(SpringClass of, double step_length) const
    {
        const double softest = softest_limit(step_length);
        return softest / (1 + softest / limited[static_cast<std::size_t>(of)].beyond);
    }
    /// 1/kg; 0 of a pinned node.
    double inverse_mass(std::size_t node) const { return pinned[node] ? 0 : 1 / masses[node]; }
    /// Lets go of the positions and velocities at the start, once a backend has them.
    void forget_start()
    {
        std::vector<Vec3>().swap(positions);
        std::vector<Vec3>().swap(velocities);
    }
    std::uint64_t spring_count() const { return spring_count_; }
    /// Structural and shear springs: those whose stretch is measured.
    std::uint64_t measured_spring_count() const { return measured_spring_count_; }
    std::uint64_t triangle_count() const;
    bool is_sheet() const { return sheet.has_value(); }
    bool node_centric() const { return node_centric_; }
    bool feels_air() const { return parameters.air_density > 0; }
    bool is_body() const { return body.has_value(); }
    /// ACAD where it can: a step is one of springs alone, and the solver makes good what it stretched too
    /// far.
    bool corrects_steps() const { return method == Method::acad && !acad_implicit; }
    /// Implicit steps go by the step before, too: BDF2 (docs/physics.md, "Constraints").
    bool is_second_order() const
    {
        return newton.order == 2 && uses_solver(method) && solver == Solver::newton_multigrid &&
               !corrects_steps();
    }
    /// s: an implicit step of a cloth that knows the step before is one of implicit Euler of this length.
    double implicit_step(double step_length) const { return (is_second_order() ? 2.0 / 3 : 1) * step_length; }
    /// A step adds external_force to its nodes: wind, or the loads of a body.
    bool has_external_force() const { return feels_air() || (body && !body->loads.empty()); }
    /// Springs, and the ring of neighbours, are gathered in one pass, which needs no list of forces.
    bool gathers_rings() const { return body && !spring_list; }

    /// Whether another body can be stepped in the same passes: it is of the same material, and near.
    bool can_take(const ClothModel& other) const;
    /// Appends a body; it is then the last of `body->parts`.
    void take(const ClothModel& other);

    /// Triangles; those of a sheet are made when first asked for.
    std::span<const Triangle> triangles() const;

    double mass() const;  ///< kg

    /// m; infinite without springs.
    double shortest_rest_length() const;

    /// Largest safe step in s from Gershgorin's theorem: see docs/physics.md, "Stability".
    double stable_step() const;

    /// Where the attached nodes are at a time, in their order; m.
    void place_attached(double time, std::span<Vec3> places) const;

    std::vector<AttachedNode> attached;  ///< nodes of moving pins
    std::vector<AttachmentMotion> motions;
    std::vector<Vec3> positions;   ///< m, at the start
    std::vector<Vec3> velocities;  ///< m/s, at the start
    std::vector<double> masses;    ///< kg
    std::vector<bool> pinned;      ///< by node
    std::optional<SheetShape> sheet;
    ClothParameters parameters;
    /// ACAD whose step is longer than explicit springs can stand: they are stepped with their limits,
    /// implicitly.
    bool acad_implicit = false;
    Method method = Method::mass_spring;  ///< see stepped_method
    Integrator integrator = Integrator::symplectic_euler;
    Solver solver = Solver::newton_multigrid;
    NewtonMultigridOptions newton;
    PaperOptions paper;
    AcadOptions acad;
    std::array<LimitedSprings, spring_class_count> limited;  ///< by class, of the constraint methods
    /// Whether bend springs are constraints: too stiff to be folded onto others in the operator.
    bool bends_by_constraints() const
    {
        const LimitedSprings& bend = limited[static_cast<std::size_t>(SpringClass::bend)];
        return method == Method::constraint && bend.exists && bend.beyond > 0;
    }
    Hierarchy hierarchy;  ///< of the constraint methods
    // Only when not node-centric:
    std::vector<Spring> springs;  ///< sorted by (i, j)
    /// Per node, sorted by the other one as the mesh numbers them; of a body see BodyModel::links
    Ragged<Neighbour> neighbours;
    /// Some have a scale, or bending, of their own. A sheet with such springs is stepped as a mesh.
    bool graded = false;
    bool meets_colliders = false;  ///< the scene has some
    double springs_across = 1;     ///< how many structural springs lead in a row from one end to the other
    double length_across = 1;      ///< m: of the cloth at rest
    double mean_mass = 0;          ///< kg, of a node
    /// At most what the largest eigenvalue of the solver's operator is against its own diagonal blocks: a
    /// term that couples n nodes has none beyond n, and a spring couples two.
    double spectrum_end = 2.5;
    bool spring_list = false;  ///< of a body: forces by the list of springs, with the method mass_spring
    // Only for a mesh:
    Ragged<std::uint32_t> node_triangles;  ///< per node the triangles around it, ascending

    // Only for soft bodies:
    std::optional<BodyModel> body;
    std::span<const Neighbour> ring_of(std::size_t node) const
    {
        return {neighbours.entries.data() + neighbours.start[node],
                neighbours.entries.data() + body->links[node]};
    }
    std::span<const Neighbour> links_of(std::size_t node) const
    {
        return {neighbours.entries.data() + body->links[node],
                neighbours.entries.data() + neighbours.start[node + 1]};
    }
    Vec3d origin;  ///< m: positions are against it; 0 but for a body, which is stepped near its own origin
    /// The node of each vertex of the mesh; empty where they are the same.
    std::vector<std::uint32_t> node_of_vertex;
    std::uint32_t node(std::uint32_t vertex) const
    {
        return node_of_vertex.empty() ? vertex : node_of_vertex[vertex];
    }

private:
    void build_body(const Cloth& cloth, const Scene& scene);
    void list_body_springs(const BodyOptions& options, const Ragged<std::uint32_t>& rings);
    void finish_body(const Cloth& cloth);
    void set_loads(const Cloth& cloth);
    void build_sheet(const Cloth& cloth, const SheetOptions& options);
    void build_mesh(const Cloth& cloth, const SurfaceMesh& mesh);
    void list_node_triangles();
    void set_masses(const Cloth& cloth);
    void set_pins(const Cloth& cloth);
    void set_springs(const Cloth& cloth, const Scene& scene);
    void list_sheet_springs();
    void list_mesh_springs();
    void grade_springs(const Cloth& cloth);
    void list_neighbours();
    /// At place k of `order` is the vertex that becomes node k.
    void renumber(const std::vector<std::uint32_t>& order);

    bool node_centric_ = false;
    std::uint64_t spring_count_ = 0, measured_spring_count_ = 0;
    mutable std::vector<Triangle> triangles_;
};

/// Visits the springs of a sheet in the order of (i, j): f(i, j, const SheetNeighbour&).
template <class Function>
void for_each_sheet_spring(const SheetShape& sheet, Function&& f)
{
    for (std::uint32_t row = 0; row < sheet.rows; ++row)
        for (std::uint32_t column = 0; column < sheet.columns; ++column)
            for (std::size_t n = 6; n < 12; ++n) {
                const std::int64_t r = row + std::int64_t{sheet_neighbours[n].row_offset};
                const std::int64_t c = column + std::int64_t{sheet_neighbours[n].column_offset};
                if (r < 0 || c < 0 || r >= sheet.rows || c >= sheet.columns) continue;
                f(row * sheet.columns + column, static_cast<std::uint32_t>(r * sheet.columns + c),
                  sheet_neighbours[n]);
            }
}

}  // namespace pliant
