// A cloth prepared for stepping: nodes, springs, triangles and the connectivity between them.
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
    shear = 1,  ///< of a soft body: internal springs
    bend = 2
};
constexpr std::size_t spring_class_count = 3;

/// A spring between nodes i < j.
struct Spring {
    std::uint32_t i = 0, j = 0;
    SpringClass spring_class = SpringClass::structural;
    double rest_length = 0;  ///< m
    double scale = 1;        ///< multiplies stiffness and damping of its class
    /// N/m, may be negative: weight in the quadratic bending energy, bending / 2 (x_j - x_i)^2, see
    /// bending.hpp
    double bending = 0;
};

/// One of the up to 12 springs of a sheet's node.
struct SheetNeighbour {
    int row_offset = 0, column_offset = 0;
    SpringClass spring_class = SpringClass::structural;
    int rest = 0;  ///< index into SheetShape::rest_lengths
};

/// The canonical order in which every backend adds a node's springs: by the neighbour's index, so the six
/// backward neighbours come first, in row order, then the forward ones.
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

/// Constant over a run, except for what Simulation changes per frame (the length of a step).
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

/// A class of springs in the constraint methods: as LimitCurve of laws/limit.law.glsl.
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

/// A node attached to a moving pin.
struct AttachedNode {
    std::uint32_t node = 0;
    std::uint32_t motion = 0;  ///< index into ClothModel::motions
    Vec3d arm;                 ///< m, from the centre of the pin's nodes, at the start
};
struct AttachmentMotion {
    Vec3d centre;  ///< m
    std::vector<Keyframe> keyframes;
};

/// Methods that use the constraint solver.
constexpr bool uses_solver(Method method) { return method == Method::constraint || method == Method::acad; }

/// The method whose passes step a scene: implicit Euler uses those of `constraint`, without constraints.
inline Method stepped_method(const Scene& scene)
{
    return scene.integrator == Integrator::implicit_euler ? Method::constraint : scene.method;
}

class ClothModel {
public:
    ClothModel(const Cloth& cloth, const Scene& scene);

    std::uint32_t node_count() const { return static_cast<std::uint32_t>(masses.size()); }
    /// Whether limits of a class keep their forces from step to step: see renewed_limit in
    /// laws/limit.law.glsl.
    bool remembers(SpringClass of) const;
    bool remembers_any() const { return remembers(SpringClass::structural) || remembers(SpringClass::shear); }
    /// Whether all springs whose strain is measured are such limits, and softer than their compliance in
    /// steps of `step_length` s; and the largest limit.
    bool does_not_stretch(double step_length) const;
    double largest_limit() const;
    /// N/m: the softest stiffness that corrects such a limit, in steps of `step_length` s; and for springs of
    /// a class, with their compliance.
    double softest_limit(double step_length) const;
    /// The softest limits, in m n^2 / dt^2, that pass a pull through all n springs across the cloth within
    /// one step, if colliders hold it up (docs/physics.md, "Constraints").
    static constexpr double firm_limit = 18.4;
    /// The factor on the stiffness of limits between a mesh's node and a pin. They alone bear what hangs
    /// there, and a jerk stretches them by the change of force over their stiffness.
    static constexpr double held_limit = 4;
    /// m: maximum displacement by a polish where only inertia resists (newton_polish). On a mesh 1/25 of a
    /// spring's length, which is a strain of 0.08 %, or 0.3 % if both its nodes move; unlimited on sheets.
    double polish_reach() const { return is_sheet() ? 1e9 : 0.04 * length_across / springs_across; }
    /// The part of its stiffness that a slack limit with memory keeps in Newton's matrix. On a mesh half of
    /// the limits are slack, and would hold up falling nodes; on a sheet less than 1 takes more iterations.
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
    /// 1/kg; 0 for a pin.
    double inverse_mass(std::size_t node) const { return pinned[node] ? 0 : 1 / masses[node]; }
    /// Frees the initial positions and velocities, once a backend has copied them.
    void forget_start()
    {
        std::vector<Vec3>().swap(positions);
        std::vector<Vec3>().swap(velocities);
    }
    std::uint64_t spring_count() const { return spring_count_; }
    /// Structural and shear springs: those whose strain is measured.
    std::uint64_t measured_spring_count() const { return measured_spring_count_; }
    std::uint64_t triangle_count() const;
    bool is_sheet() const { return sheet.has_value(); }
    bool node_centric() const { return node_centric_; }
    bool feels_air() const { return parameters.air_density > 0; }
    bool is_body() const { return body.has_value(); }
    /// ACAD with explicit springs: each step is made with springs alone, and the solver corrects those that
    /// are too long.
    bool corrects_steps() const { return method == Method::acad && !acad_implicit; }
    /// Implicit steps use the previous step, too: BDF2 (docs/physics.md, "Constraints").
    bool is_second_order() const
    {
        return newton.order == 2 && uses_solver(method) && solver == Solver::newton_multigrid &&
               !corrects_steps();
    }
    /// s: with history, an implicit step equals one of implicit Euler of this length.
    double implicit_step(double step_length) const { return (is_second_order() ? 2.0 / 3 : 1) * step_length; }
    /// Whether a step adds external_force to its nodes: wind, or the loads of a body.
    bool has_external_force() const { return feels_air() || (body && !body->loads.empty()); }
    /// Whether one pass gathers springs and the ring of neighbours, without a list of forces.
    bool gathers_rings() const { return body && !spring_list; }

    /// Whether another body can be stepped in the same passes: it has the same material, and is near.
    bool can_take(const ClothModel& other) const;
    /// Appends a body, as the last of `body->parts`.
    void take(const ClothModel& other);

    /// Triangles; a sheet's are made on first use.
    std::span<const Triangle> triangles() const;

    double mass() const;  ///< kg

    /// m; infinite without springs.
    double shortest_rest_length() const;

    /// The largest step in s that is certainly stable, by Gershgorin's theorem: see docs/physics.md,
    /// "Stability".
    double stable_step() const;

    /// Positions of the attached nodes at a time, in their order; m.
    void place_attached(double time, std::span<Vec3> places) const;

    std::vector<AttachedNode> attached;  ///< nodes of moving pins
    std::vector<AttachmentMotion> motions;
    std::vector<Vec3> positions;   ///< m, at the start
    std::vector<Vec3> velocities;  ///< m/s, at the start
    std::vector<double> masses;    ///< kg
    std::vector<bool> pinned;      ///< by node
    std::optional<SheetShape> sheet;
    ClothParameters parameters;
    /// ACAD with a step too long for explicit springs: springs and limits are stepped together, implicitly.
    bool acad_implicit = false;
    Method method = Method::mass_spring;  ///< see stepped_method
    Integrator integrator = Integrator::symplectic_euler;
    Solver solver = Solver::newton_multigrid;
    NewtonMultigridOptions newton;
    PaperOptions paper;
    AcadOptions acad;
    std::array<LimitedSprings, spring_class_count> limited;  ///< by class, for the constraint methods
    /// Whether bend springs are constraints: too stiff to be folded onto others in the operator.
    bool bends_by_constraints() const
    {
        const LimitedSprings& bend = limited[static_cast<std::size_t>(SpringClass::bend)];
        return method == Method::constraint && bend.exists && bend.beyond > 0;
    }
    Hierarchy hierarchy;  ///< for the constraint methods
    // Only for lists of springs:
    std::vector<Spring> springs;  ///< sorted by (i, j)
    /// By node, sorted by the other node in the mesh's numbering; for a body see BodyModel::links.
    Ragged<Neighbour> neighbours;
    /// Some springs have individual scales or bending weights. A sheet with such springs is stepped as a
    /// mesh.
    bool graded = false;
    bool meets_colliders = false;  ///< the scene has colliders
    double springs_across = 1;     ///< number of structural springs in a row from one end to the other
    double length_across = 1;      ///< m: of the cloth at rest
    double mean_mass = 0;          ///< kg, of a node
    /// An upper bound of the eigenvalues of D^-1 A, with the diagonal blocks D of the solver's operator A: a
    /// term that couples n nodes contributes at most n, and a spring couples two.
    double spectrum_end = 2.5;
    bool spring_list = false;  ///< of a body: forces by a list of springs, for the method mass_spring
    // Only for a mesh:
    Ragged<std::uint32_t> node_triangles;  ///< by node, ascending

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
    Vec3d origin;  ///< m: positions are relative to it; 0 except for a body, which has an origin near itself
    /// The node of each vertex of the mesh; empty if the order is the same.
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
    /// order[k] is the vertex that becomes node k.
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
